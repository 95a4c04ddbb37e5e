// An isotropic reflectance in cells of half_difference.h: θ_h in steps of its square root, which are fine about the
// mirror's direction, θ_d and φ_d in even ones. With n cells, cell i holds the value at
//
//   θ_h = π/2 ((i+½)/n)²,   θ_d = π/2 (i+½)/n,   φ_d = π (i+½)/n
#pragma once

#include <vector>

#include "burnish/brdf/brdf.h"

namespace burnish {

struct HalfDifferenceCells {
  int theta_h = 90, theta_d = 90, phi_d = 180;
  std::size_t count() const { return std::size_t(theta_h) * theta_d * phi_d; }
};

class HalfDifferenceTable final : public Brdf {
 public:
  // f_r by [θ_h][θ_d][φ_d], in 1/sr; NaN where it is not known, which interpolation passes over.
  HalfDifferenceTable(const HalfDifferenceCells& cells, std::vector<Vec3f> values);

 private:
  Vec3d reflected_above(Vec3d l, Vec3d v) const override;

  HalfDifferenceCells cells_;
  std::vector<Vec3f> values_;
};

}  // namespace burnish
