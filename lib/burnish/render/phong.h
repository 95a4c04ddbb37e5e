// Lambertian reflection and Phong's highlight (Phong 1975; Tarini et al., section 5.1, number 2):
//   k_d · max(0, n·l) + k_s · max(0, r·v)^e,  r = 2 (n·l) n − l,  the highlight only where n·l > 0.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/core/vec3.h"
#include "burnish/render/light.h"

namespace burnish {

struct Phong {
  Vec3d ambient{1, 1, 1}, diffuse{1, 1, 1}, specular{0.5, 0.5, 0.5};
  double exponent = 20;

  // Share of the light's colour that leaves towards the viewer; unit vectors of one space.
  Vec3d reflect(Vec3d n, Vec3d to_light, Vec3d to_viewer) const {
    const double cosine = dot(n, to_light);
    if (cosine <= kGrazing) return diffuse * std::max(0.0, cosine);
    const Vec3d mirrored = n * (2 * cosine) - to_light;
    return diffuse * cosine + specular * std::pow(std::max(0.0, dot(mirrored, to_viewer)), exponent);
  }
};

}  // namespace burnish
