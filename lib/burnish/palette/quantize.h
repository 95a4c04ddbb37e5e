// Normal maps, and materials, to indexed normal maps with one palette (Tarini et al., sections 4 and 6).
//
// A histogram of the distinct (material, normal) pairs of all maps, a palette fitted to it, entries in order of
// material and along a curve, then each texel's nearest entry of its own material, dithered or not. Deterministic,
// whatever the threads and the order of the maps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/normal/coding.h"
#include "burnish/palette/angle_stats.h"
#include "burnish/palette/dither.h"
#include "burnish/palette/fit/fit_palette.h"
#include "burnish/palette/indexed_rows.h"
#include "burnish/palette/map_set.h"

namespace burnish {

struct QuantizeOptions : PaletteOptions {
  // Use this palette instead of fitting one: with kSplit what read_palette reads, otherwise colours of the cube, as
  // read_cube_colours does.
  FileRef palette;
  Dither dither = Dither::kNone;
  double dither_amount = 1;          // [0, 1]
  std::optional<NormalSpace> space;  // none: that of a given palette, otherwise what the maps say, otherwise tangent
  NormalCoding coding;               // of the input
};

struct MapStats {
  std::size_t texels = 0;          // that count
  std::size_t invalid_texels = 0;  // of them, vectors without a direction, taken as (0,0,1)
  double rms_deg = 0, mean_deg = 0, p95_deg = 0, max_deg = 0;

  void set_angles(const AngleStats& angles);
};

struct QuantizedMapStats : MapStats {
  std::optional<NormalSpace> recorded_space;  // what the file says; the palette is in another where that was asked for
};

struct QuantizeStats : MapStats {          // over all maps
  int normals = 0;                         // palette size
  std::size_t distinct_input_normals = 0;  // (material, normal) pairs; of maps with too many, bins of them
  bool lossless = false;                   // every counting texel keeps its normal
};

struct QuantizeResult {
  Palette palette;
  QuantizeStats stats;
  std::vector<QuantizedMapStats> maps;
};

// Called for each map in their order: where its rows are to go. The palette lives as long as they come.
using MapSink = std::function<IndexRowSink(std::size_t i, const Palette& palette, int width, int height)>;

// Holds bands of rows of one map at a time. Errors: kUsage for no maps, options out of range, or colours to be written
// with kSplit; kMalformed for NaN, sizes that differ, materials a given palette lacks, fewer normals than materials, a
// mask of zeros, maps that say that they are in different spaces where nothing else decides; kUnsupported for more than
// an engine or encoding holds; kThreshold where 65536 normals miss the target error.
QuantizeResult quantize_normal_maps(std::vector<MapFiles> maps, const QuantizeOptions& options, const MapSink& sink,
                                    const Progress& progress = {});

struct QuantizedMap {
  IndexedMap map;
  QuantizeStats stats;
};

// Of a single map.
QuantizedMap quantize_normal_map(const MapFiles& map, const QuantizeOptions& options, const Progress& progress = {});

}  // namespace burnish
