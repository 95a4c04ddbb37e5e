// The light factor of a polynomial texture map (Rost, OpenGL Shading Language, 14.4.1): what the cosine c = N·L between
// the surface's own normal and the light lets through. Ambient light A, the light's colour, and a transition between
// them where the surface turns into its own shade:
//
//   F(c) = A + (light − A) w(c),   w = 0 for c ≤ 0, ½ − ½ cos(πc / WIDTH) up to c = WIDTH, 1 beyond
//
// The book names the transition without a formula; this one is smooth at both ends. WIDTH 0 is a step.
#pragma once

#include "burnish/core/portable_math.h"
#include "burnish/core/vec3.h"

namespace burnish {

inline double light_factor_share(double cosine, double width) {
  if (cosine <= 0) return 0;
  if (cosine >= width) return 1;
  return 0.5 - 0.5 * portable::cos(kPi * cosine / width);
}

inline double light_factor(double cosine, double light, double ambient, double width) {
  return ambient + (light - ambient) * light_factor_share(cosine, width);
}

}  // namespace burnish
