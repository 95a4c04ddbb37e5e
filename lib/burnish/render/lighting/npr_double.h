// A highlight that no real surface has: Phong's with the angle between reflected ray and view doubled (Tarini et al.,
// figure 6): h(cos θ) = max(0, cos 2θ)^e, and 0 from θ = 90° on, where the doubled cosine would rise again.
#pragma once

#include "burnish/core/portable_math.h"
#include "burnish/render/lighting/highlight.h"

namespace burnish {

struct NprDouble : Glossy {
  double highlight(double r_dot_v) const {
    return r_dot_v > 0 ? portable::pow(std::max(0.0, 2 * r_dot_v * r_dot_v - 1), exponent) : 0.0;
  }
  Shaded shade(Vec3d n, const Illumination& in) const { return shade_glossy(*this, n, in); }
};

}  // namespace burnish
