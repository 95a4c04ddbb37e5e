// Normal map, and materials, to an indexed normal map (Tarini et al., sections 4 and 6).
//
// A histogram of the distinct (material, normal) pairs, a palette fitted to it, entries in order of material and along
// a curve, then each texel's nearest entry of its own material, dithered or not. Deterministic, whatever the threads.
#pragma once

#include <optional>
#include <string>

#include "burnish/core/progress.h"
#include "burnish/normal/coding.h"
#include "burnish/palette/indexed_map.h"

namespace burnish {

enum class Engine { kSpherical, kMedianCut, kImagequant };
enum class Dither { kNone, kDiffusion, kBlueNoise };

struct QuantizeOptions {
  int normals = 256;                       // 2 to 65536
  std::optional<double> target_error_deg;  // instead: the smallest palette whose RMS angle, undithered, is at most that
  Engine engine = Engine::kSpherical;
  FileRef palette;   // use this palette instead of fitting one
  FileRef material;  // one channel, uint8: ids
  FileRef mask;      // texels where it is 0 do not shape the palette and do not count in the figures
  Dither dither = Dither::kNone;
  double dither_amount = 1;          // [0, 1]
  std::optional<NormalSpace> space;  // none: that of a given palette, otherwise tangent
  NormalCoding coding;               // of the input
};

struct QuantizeStats {
  std::size_t texels = 0;                  // that count
  int normals = 0;                         // palette size
  std::size_t distinct_input_normals = 0;  // (material, normal) pairs; of a map with too many, bins of them
  std::size_t invalid_texels = 0;          // vectors without a direction, taken as (0,0,1)
  double rms_deg = 0, mean_deg = 0, p95_deg = 0, max_deg = 0;
  bool lossless = false;  // every counting texel keeps its normal
};

struct QuantizeResult {
  IndexedMap map;
  QuantizeStats stats;
};

// Errors: kUsage for options out of range; kMalformed for NaN, sizes that differ, materials a given palette lacks,
// fewer normals than materials; kUnsupported for more than an engine holds; kThreshold where 65536 normals miss the
// target error.
QuantizeResult quantize_normal_map(const FileRef& file, const QuantizeOptions& options, const Progress& progress = {});

}  // namespace burnish
