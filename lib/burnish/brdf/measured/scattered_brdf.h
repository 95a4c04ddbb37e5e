// An isotropic reflectance from samples at scattered directions: interpolated into the cells of a HalfDifferenceTable.
//
// Samples lie in a space where near places mean like directions, with θ' = θ/(π/2) of half_difference.h:
//
//   ( √θ_h',  θ_d',  ½ √θ_h' sin θ_d cos 2φ_d,  ½ √θ_h' sin θ_d |sin 2φ_d| )
//
// which does not tell l from v, nor a pair from its mirror image, and where φ_d counts as much as it matters. The value
// at a place is the mean of its nearest 10 samples by the modified weights of Shepard's method, ((R − d)⁺/(R d))², d
// their distance and R that of the eleventh: exact at the samples, and never beyond their values. The mean is taken of
// asinh(f/0.01), in which a sharp highlight does not drown all about it. Coordinates and number were chosen by the
// errors of samples left out in turn. (Franke & Nielson, "Smooth interpolation of large sets of scattered data", 1980.)
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "burnish/brdf/measured/half_difference_table.h"

namespace burnish {

struct ReflectanceSample {
  Vec3d l, v;       // unit, above the surface
  Vec3d reflected;  // f_r, in 1/sr
};

class ScatteredReflectance {
 public:
  static constexpr std::size_t kNearest = 10;

  // More than kNearest samples.
  explicit ScatteredReflectance(const std::vector<ReflectanceSample>& samples);
  // f_r. Unit vectors above the surface.
  Vec3d at(Vec3d l, Vec3d v) const;

 private:
  using Place = std::array<double, 4>;
  struct Sample {
    Place place;
    Vec3d value;  // asinh(f/0.01)
  };
  std::vector<Sample> sorted_;  // by the first coordinate
};

// Its values at the middles of cells. In parallel.
std::shared_ptr<const Brdf> interpolated(const std::vector<ReflectanceSample>& samples,
                                         const HalfDifferenceCells& cells = {});

}  // namespace burnish
