// Normals of a surface from its polynomial texture map: of each texel the direction in which it is brightest
// (brightest_direction.h), of an RGB map that of the sum of its channels.
#pragma once

#include <cstddef>

#include "burnish/core/progress.h"
#include "burnish/normal/height_map.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct PtmNormalStats {
  std::size_t flat_texels = 0;     // under every light alike: (0,0,1)
  std::size_t horizon_texels = 0;  // brightest under a light along the surface
  double mean_tilt_deg = 0;
};

// Writes them in tangent space, x to the right and y to the top of the photographs. Errors as ImageWriter and
// require_encodable().
PtmNormalStats write_ptm_normals(const PtmRows& rows, const NormalMapTarget& target, const Progress& progress = {});

}  // namespace burnish
