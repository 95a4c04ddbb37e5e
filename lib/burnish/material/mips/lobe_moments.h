// Normals and widths of many lobes summed up, and the one lobe that has the same.
//
// LEAN mapping with unit normals in place of slopes, so that none is too steep: with weights w, each lobe's energy,
//
//   n' = Σ w n / ‖…‖,   Σ' = Σ w (n nᵀ + σ_x² t tᵀ + σ_y² b bᵀ) / Σw − m mᵀ,  m = Σ w n / Σw,
//
// σ_x² and σ_y² being the variances of the lobe's slope (lobe.h). In the plane across n' the eigenvectors of Σ' are t'
// and b', its eigenvalues the variances: for small slopes what LEAN's slope covariance is. k_s' is what keeps the
// energy. Source: Olano & Baker, "LEAN mapping" (2010), section 3.
#pragma once

#include "burnish/material/mips/lobe.h"

namespace burnish {

class LobeMoments {
 public:
  LobeMoments() = default;
  LobeMoments(MaterialModel model, const Lobe& lobe);
  // Adds a weighted share of others.
  void add(const LobeMoments& other, double weight);

  // Of weights that sum to 1. Its t is the axis nearest to the mean of theirs.
  Lobe lobe(MaterialModel model) const;
  Vec3d mean_normal() const { return mean_normal_; }  // not renormalised
  Vec3d tangent() const { return tangent_; }          // Σ w t

 private:
  Vec3d second_times(Vec3d v) const { return second_[0] * v.x + second_[1] * v.y + second_[2] * v.z; }

  double energy_ = 0, weight_ = 0, exponent_ = 0;
  Vec3d mean_normal_, normal_, tangent_;
  Vec3d second_[3];  // columns
};

// The same lobe with t and b exchanged or turned about, so that t lies nearest to a direction. Of banks t is turned
// about only.
Lobe turned_towards(MaterialModel model, const Lobe& lobe, Vec3d tangent);

}  // namespace burnish
