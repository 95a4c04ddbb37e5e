// A glossy surface: ambient and Lambertian reflection, and on top of it a highlight about the mirrored direction,
//   k_s · colour · h(r·v),  r = 2 (n·l) n − l,  only where n·l > 0.
// The models that share this differ in h alone.
#pragma once

#include "burnish/render/lighting/lambert.h"

namespace burnish {

struct Glossy : Lambert {
  Vec3d specular{0.5, 0.5, 0.5};
  double exponent = 20;
};

template <typename Model>
Shaded shade_glossy(const Model& model, Vec3d n, const Illumination& in) {
  Shaded out = model.Lambert::shade(n, in);
  for (const Arriving& light : in.lights) {
    const double cosine = dot(n, light.direction);
    if (cosine <= kRounding) continue;
    const Vec3d r = n * (2 * cosine) - light.direction;
    out.specular += light.colour * model.specular * model.highlight(dot(r, in.to_viewer));
  }
  return out;
}

}  // namespace burnish
