// Ambient light and Lambertian reflection of any number of lights (Tarini et al., section 5.1, number 1):
//   k_a · ambient + Σ k_d · colour · max(0, n·l).  No 1/π: k_d = 1 facing a light of intensity 1 is 1.
#pragma once

#include <algorithm>

#include "burnish/render/lighting/lighting.h"

namespace burnish {

struct Lambert {
  Vec3d ambient{1, 1, 1}, diffuse{1, 1, 1};

  Shaded shade(Vec3d n, const Illumination& in) const {
    Vec3d sum = in.ambient * ambient;
    for (const Arriving& light : in.lights) sum += light.colour * diffuse * std::max(0.0, dot(n, light.direction));
    return {sum, {}};
  }
};

}  // namespace burnish
