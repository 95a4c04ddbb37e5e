// The lights that a texel of a BRDF PTM can be seen under, as points of a quadrature over their solid angle.
//
// half-difference: light and view lie on either side of the texel's H, and both are above the surface on a part of the
// hemisphere about H, a lune. With θ_h the angle from the normal to H, α that of the light about the axis across both,
// and w its cosine to that axis, solid angle is dα dw and the lune is |α| < π/2 − θ_h, |w| < 1. Where H is the normal
// it is the whole hemisphere; light-view has that at every texel. Points: Gauss and Legendre's rule over either.
// difference-half: the same points for H, without those that put light or view below the surface.
#pragma once

#include <vector>

#include "burnish/ptm/brdf/brdf_coordinates.h"

namespace burnish {

struct CapPoint {
  Vec3d l, v;
  double u, w;         // of the polynomial
  double solid_angle;  // its share
};

class LightCaps {
 public:
  // points² of them at each texel.
  LightCaps(BrdfCoordinates coordinates, int points);

  // Of the texture's place (x, y), which is inside the unit disc.
  void points_at(double x, double y, std::vector<CapPoint>& out) const;

 private:
  BrdfCoordinates coordinates_;
  std::vector<double> place_, weight_;  // the rule over [−1, 1]
};

}  // namespace burnish
