// Phong's highlight (Phong 1975; Tarini et al., section 5.1, number 2): h(r·v) = max(0, r·v)^e.
#pragma once

#include "burnish/core/portable_math.h"
#include "burnish/render/lighting/highlight.h"

namespace burnish {

struct Phong : Glossy {
  double highlight(double r_dot_v) const { return portable::pow(std::max(0.0, r_dot_v), exponent); }
  Shaded shade(Vec3d n, const Illumination& in) const { return shade_glossy(*this, n, in); }
};

}  // namespace burnish
