// Chrome: what a mirror shows of a typical landscape, brown below and blue above (Tarini et al., figure 7).
//
// With w the up component (+y of the world) of the mirrored view: from `horizon` at w = 0 to `sky` at w = 1 above, from
// `ground` at w = 0 to `nadir` at w = −1 below. The step at the horizon is what makes it look like metal.
#pragma once

#include "burnish/render/lighting/lighting.h"

namespace burnish {

struct Chrome {
  Vec3d specular{1, 1, 1};  // of the metal: multiplies what is mirrored
  Vec3d sky{0.1, 0.25, 0.8}, horizon{0.85, 0.93, 1.0}, ground{0.12, 0.06, 0.02}, nadir{0.5, 0.32, 0.15};

  Shaded shade(Vec3d n, const Illumination& in) const {
    const double w = mirrored(in.to_viewer, n).y;
    const Vec3d seen = w > kRounding ? horizon + (sky - horizon) * w : ground + (nadir - ground) * -w;
    return {{}, specular * seen};
  }
};

}  // namespace burnish
