// Lambertian reflection: k_d · max(0, n·l). No 1/π: a surface of k_d = 1 facing a light of intensity 1 is 1.
#pragma once

#include <algorithm>

#include "burnish/core/vec3.h"

namespace burnish {

struct Lambert {
  Vec3d ambient{1, 1, 1}, diffuse{1, 1, 1};

  // Share of the light's colour that leaves towards the viewer; unit vectors of one space.
  Vec3d reflect(Vec3d n, Vec3d to_light, Vec3d /*to_viewer*/) const {
    return diffuse * std::max(0.0, dot(n, to_light));
  }
};

}  // namespace burnish
