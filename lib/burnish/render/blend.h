// How shading and the surface's own colour come together (Tarini et al., section 7), for a base colour c, Lambertian
// intensity α and reflected light s, per channel:
//   exact        c·α + (1 − c·α)·s   (equation 1)
//   approximate  c·α + (1 − c)·s     (equation 2, one pass less)
//   material     d + s               (section 7.3: the colour is the material's; d the diffuse part, no base colour)
// Nothing is clamped: where c·α exceeds 1, so does what comes out.
#pragma once

#include "burnish/render/lighting/lighting.h"

namespace burnish {

enum class Blend { kMaterial, kExact, kApproximate };

inline Vec3d blend_exact(Vec3d c, double alpha, Vec3d s) {
  const Vec3d lit = c * alpha;
  return lit + (Vec3d{1, 1, 1} - lit) * s;
}

inline Vec3d blend_approximate(Vec3d c, double alpha, Vec3d s) { return c * alpha + (Vec3d{1, 1, 1} - c) * s; }

// α is the luminance of the diffuse part, and that part itself where lights and material are grey.
inline Vec3d blend(Blend mode, Vec3d base, const Shaded& shaded) {
  switch (mode) {
    case Blend::kExact:
      return blend_exact(base, luminance(shaded.diffuse), shaded.specular);
    case Blend::kApproximate:
      return blend_approximate(base, luminance(shaded.diffuse), shaded.specular);
    case Blend::kMaterial:
      break;
  }
  return shaded.diffuse + shaded.specular;
}

}  // namespace burnish
