// Light and view by their half vector and their difference from it, for isotropic surfaces (Rusinkiewicz, "A new change
// of variables for efficient BRDF representation", 1998):
//
//   θ_h  from the normal to h = (l+v)/‖l+v‖
//   θ_d  from h to l
//   φ_d  of l about h, from the direction that leads away from the normal; mod π, since l and v may be exchanged
#pragma once

#include <algorithm>

#include "burnish/core/portable_math.h"
#include "burnish/core/vec3.h"

namespace burnish {

struct HalfDifference {
  double theta_h, theta_d;  // 0 … π/2
  double phi_d;             // 0 ≤ φ_d < π
};

// Unit vectors that are not opposite; the normal is z.
inline HalfDifference half_difference(Vec3d l, Vec3d v) {
  const Vec3d h = normalized(l + v);
  const double sine = portable::hypot(h.x, h.y);
  // Where h is the normal, any direction is as good.
  const Vec3d away = sine > 0 ? Vec3d{h.z * h.x / sine, h.z * h.y / sine, -sine} : Vec3d{1, 0, 0};
  const Vec3d d = l - h * dot(l, h);
  double phi = portable::atan2(dot(l, cross(h, away)), dot(l, away));
  if (phi < 0) phi += kPi;
  if (phi >= kPi) phi -= kPi;
  return {portable::atan2(sine, h.z), portable::atan2(length(d), std::max(0.0, dot(l, h))), std::max(0.0, phi)};
}

}  // namespace burnish
