// Where a surface is brightest: the normal that a polynomial's maximum stands for.
//
// Under one light a matte surface is brightest where the light stands along its normal, (u, v) being its x and y. The
// polynomial is f(x) = xᵀAx + bᵀx + c of x = (u, v); its maximum over the unit disc is
//
//   x = ½ (λI − A)⁻¹ b   with the least λ ≥ max(0, μ), μ the larger eigenvalue of A, that leaves ‖x‖ ≤ 1
//
// inside with λ = 0, and on the circle where ‖x‖ = 1: not the stationary point brought back to it.
// Sources: Malzbender, Gelb & Wolters, "Polynomial texture maps" (2001), section 5, equations 16 to 18, for the maximum
// inside; Moré & Sorensen, "Computing a trust region step" (1983), for the disc.
#pragma once

#include "burnish/core/vec3.h"
#include "burnish/ptm/basis.h"

namespace burnish {

struct BrightestDirection {
  Vec3d direction{0, 0, 1};  // unit, z ≥ 0
  bool flat = false;         // no coefficient but the last above a thousandth of a step of 8 bits: (0,0,1)
  bool on_horizon = false;   // the maximum lies on the circle: z is 0
};

// Where two maxima are alike, opposite each other, the one of the larger u, then v. Coefficients are of light to 255.
BrightestDirection brightest_direction(const PtmCoefficients<double>& a);

}  // namespace burnish
