// Displacement map to normal map, streamed in bands of rows (Tarini et al., section 4.1).
//
// Memory holds a few bands, whatever the height of the map. Reading, fitting and writing overlap; the fit of each texel
// depends on its neighbourhood alone, so that no result depends on the number of threads or on where a band ends.
#pragma once

#include <string>

#include "burnish/core/image_io.h"
#include "burnish/core/progress.h"
#include "burnish/normal/coding.h"
#include "burnish/normal/plane_fit.h"

namespace burnish {

enum class Wrap {
  kFit,     // the fit uses only texels that exist
  kClamp,   // the edge texel goes on
  kRepeat,  // the other side follows
  kMirror,  // … 1 0 0 1 …: the edge texel is repeated
};

struct HeightMapOptions {
  double height = 1;     // displacement of the value 1.0, in the units of size; finite
  double mid_level = 0;  // stored value that means no displacement; finite; no fit depends on it
  double size_u = 0;     // extent of the whole map; 0: one unit a texel
  double size_v = 0;     // 0: as size_u, by the map's proportions
  int neighbors = 4;
  FitWeights weights = FitWeights::kUniform;
  Wrap wrap_u = Wrap::kFit, wrap_v = Wrap::kFit;
  std::string channel;  // name or number from 0; empty: the first
  FileRef mask;         // optional; where it is 0 a texel takes no part and stores (0,0,1)
};

struct HeightMapStats {
  int width = 0, height = 0;
  double max_slope_deg = 0;             // steepest angle between a plane and the map
  double mean_tilt_deg = 0;             // its mean over the texels that take part
  std::size_t degenerate_texels = 0;    // fewer than three usable points off a line: stored as (0,0,1)
  bool colour_channels_differ = false;  // and none was chosen
};

struct NormalMapTarget {
  FileRef file;
  FileType type = FileType::kPng;
  SampleType sample = SampleType::kUint8;
  NormalCoding coding;  // channels are not used
};

// Writes normals in tangent space. kMalformed for NaN or infinity where the mask does not exclude it, for slopes beyond
// floating point, for a mask of another size and for a channel the file does not have; kUsage for sizes and heights out
// of range.
HeightMapStats convert_height_map(const FileRef& height, const HeightMapOptions& options, const NormalMapTarget& target,
                                  const Progress& progress = {});

}  // namespace burnish
