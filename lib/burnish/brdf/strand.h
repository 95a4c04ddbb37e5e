// A strand of circular cross-section, lit by Phong's model with the best of its normals (Isidoro & Brennan 2002, after
// Banks 1994): N' is the light projected into the plane across the strand, and with a = L·T and b = V·T
//
//   diffuse   L·N' = √(1 − a²)
//   specular (V·R')ⁿ = max(0, √(1 − a²) √(1 − b²) − a b)ⁿ
//
// The second is the printed formula: the largest value over all normals of the strand, which is more than V·R' for
// N' alone, where V does not lie in the plane of L and T. The printed R' = 2N'(N'·V) − V mirrors the view where
// Phong mirrors the light; V·R' would then be of V and its own mirror image, and the light's is what the formula needs.
// Exchanging L and V changes nothing in the specular part.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/core/portable_math.h"
#include "burnish/core/vec3.h"

namespace burnish {

// Of cosines in [−1,1].
inline double strand_diffuse(double l_dot_t) { return std::sqrt(std::max(0.0, 1 - l_dot_t * l_dot_t)); }
inline double strand_specular(double l_dot_t, double v_dot_t, double exponent) {
  const double v_dot_r = strand_diffuse(l_dot_t) * strand_diffuse(v_dot_t) - l_dot_t * v_dot_t;
  return portable::pow(std::max(0.0, v_dot_r), exponent);
}

}  // namespace burnish
