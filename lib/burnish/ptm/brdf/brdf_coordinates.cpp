#include "burnish/ptm/brdf/brdf_coordinates.h"

namespace burnish {

const char* name(BrdfCoordinates coordinates) {
  static const char* const names[] = {"half-difference", "light-view", "difference-half"};
  return names[int(coordinates)];
}

BrdfPlace brdf_place(BrdfCoordinates coordinates, Vec3d l, Vec3d v) {
  if (coordinates == BrdfCoordinates::kLightView) return {v.x, v.y, l.x, l.y};
  const Vec3d h = normalized(l + v);
  const HalfFrame f = half_frame(h);
  const double du = dot(l, f.t), dv = dot(l, f.b);
  if (coordinates == BrdfCoordinates::kHalfDifference) return {h.x, h.y, du, dv};
  return {du, dv, h.x, h.y};
}

}  // namespace burnish
