// Coefficients rounded to the bytes of a file so that the light they stand for changes least.
//
// A change d of the coefficients changes the squared error over the lights by dᵀGd (light_matrix.h). Rounding each by
// itself ignores that they make up for each other; the nearest of all bytes is a closest vector problem in six
// dimensions. Here: Babai's nearest plane, one coefficient after the other with the errors of those before it fed back,
// then steps of one in one or two coefficients while they lower the error.
// Source: Babai, "On Lovász' lattice reduction and the nearest lattice point problem" (Combinatorica, 1986).
#pragma once

#include <array>
#include <cstdint>

#include "burnish/ptm/basis.h"

namespace burnish {

// a = (raw − bias) · scale
struct ByteRange {
  PtmCoefficients<double> scale{1, 1, 1, 1, 1, 1};
  PtmCoefficients<int> bias{};
};

// The bytes from 0 to 255 over [least, most] of each term. Scales are above 0; where the two are equal, the one
// value is held exactly.
ByteRange byte_range(const PtmCoefficients<double>& least, const PtmCoefficients<double>& most);

class CoefficientRounding {
 public:
  // `normal`: G.
  CoefficientRounding(const ByteRange& range, const std::array<PtmCoefficients<double>, kPtmTerms>& normal);

  PtmCoefficients<std::uint8_t> rounded(const PtmCoefficients<float>& a) const;
  // dᵀGd of bytes against what they stand for.
  double squared_error(const PtmCoefficients<float>& a, const PtmCoefficients<std::uint8_t>& raw) const;

 private:
  using Real = PtmCoefficients<double>;
  Real in_steps(const PtmCoefficients<float>& a) const;

  ByteRange range_;
  std::array<Real, kPtmTerms> h_{};         // G in steps of the bytes
  std::array<Real, kPtmTerms> feedback_{};  // rows of its Cholesky factor over their diagonal
};

}  // namespace burnish
