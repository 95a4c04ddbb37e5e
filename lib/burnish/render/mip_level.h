// Which level of a chain a pixel looks into.
//
// The footprint of a pixel on the base level, in texels, is ρ = max(|∂(uW, vH)/∂x|, |∂(uW, vH)/∂y|), and λ =
// log₂ ρ (OpenGL 4.6, section 8.14). The nearest level is ⌈λ + ½⌉ − 1, within the chain: a tie takes the
// finer one. With several samples a pixel the derivatives are those of one sample.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/core/portable_math.h"
#include "burnish/render/surface.h"

namespace burnish {

enum class MipMode { kOff, kNearest, kLinear };

// λ ≥ 0, at most the last level; 0 where the map is magnified.
inline double mip_lambda(const SurfacePoint& p, int width, int height, int samples, int levels) {
  const double x = portable::hypot(p.du_dx * width, p.dv_dx * height),
               y = portable::hypot(p.du_dy * width, p.dv_dy * height);
  const double footprint = std::max(x, y) / samples;
  return footprint > 1 ? std::min(portable::log2(footprint), double(levels - 1)) : 0.0;
}

inline int nearest_level(double lambda) { return std::max(0, int(std::ceil(lambda + 0.5)) - 1); }

}  // namespace burnish
