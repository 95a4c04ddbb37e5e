// What of light and view addresses a BRDF PTM's texture, and what its polynomial takes (Rost, OpenGL Shading Language,
// 14.4.2), in the surface's frame T, B, N = x, y, z:
//
//   half-difference   texture (T·H, B·H),   polynomial (L·T', L·B'),  T' = T − (T·H) H normalised, B' = H × T'
//   light-view        texture (T·V, B·V),   polynomial (T·L, B·L)
//   difference-half   the first with the two exchanged
//
// The listings do the first; the book's prose speaks of the third, which is here to be compared with. A texture
// coordinate c from −1 to 1 lies at ½c + ½.
#pragma once

#include "burnish/core/vec3.h"

namespace burnish {

enum class BrdfCoordinates { kHalfDifference, kLightView, kDifferenceHalf };
const char* name(BrdfCoordinates coordinates);

struct BrdfPlace {
  double x, y;  // of the texture
  double u, v;  // of the polynomial
};

// T', B', H; where H is T, B stays.
struct HalfFrame {
  Vec3d t, b, h;
};
inline HalfFrame half_frame(Vec3d h) {
  const Vec3d left = Vec3d{1, 0, 0} - h * h.x;
  const double size = length(left);
  if (!(size > 1e-9)) return {cross(Vec3d{0, 1, 0}, h), {0, 1, 0}, h};
  return {left / size, cross(h, left / size), h};
}

// Unit vectors that are not opposite.
BrdfPlace brdf_place(BrdfCoordinates coordinates, Vec3d l, Vec3d v);

}  // namespace burnish
