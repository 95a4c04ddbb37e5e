// Coefficients rounded to the bytes of a file so that the light they stand for changes least.
//
// A change d of the coefficients changes the squared error over the lights by dᵀGd (light_matrix.h). Rounding each by
// itself ignores that they make up for each other; the nearest of all bytes is a closest vector problem in six
// dimensions. Here: Babai's nearest plane, one coefficient after the other with the errors of those before it fed back;
// then, as the iterative slicer does, whole steps along the shortest vectors of the lattice while they bring it nearer.
// Of the 63 vectors that bound the lattice's cell, the shortest of each class modulo 2, the shortest 16 nearly suffice.
// Sources: Babai, "On Lovász' lattice reduction and the nearest lattice point problem" (Combinatorica, 1986); Sommer,
// Feder & Shalvi, "Finding the closest lattice point by iterative slicing" (SIAM J. Discrete Math., 2009).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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
  // `normal`: G. Scales may be 0, as in files of other programs: what they hold is 0.
  CoefficientRounding(const ByteRange& range, const std::array<PtmCoefficients<double>, kPtmTerms>& normal);

  // `count` polynomials of six, whose coefficients are within some steps of the range.
  void round(const float* coefficients, std::size_t count, std::uint8_t* raw) const;
  PtmCoefficients<std::uint8_t> rounded(const PtmCoefficients<float>& a) const;
  // dᵀGd of bytes against what they stand for.
  double squared_error(const PtmCoefficients<float>& a, const PtmCoefficients<std::uint8_t>& raw) const;

  // A vector d of the lattice of bytes, and Hd / dᵀHd, H being G in steps of the bytes.
  struct Direction {
    float step[kPtmTerms], slope[kPtmTerms];
  };

 private:
  using Real = PtmCoefficients<double>;

  ByteRange range_;
  std::array<Real, kPtmTerms> h_{};            // G in steps of the bytes
  float feedback_[kPtmTerms][kPtmTerms] = {};  // rows of its upper factor over their diagonal
  std::vector<Direction> directions_;          // shortest first
};

}  // namespace burnish
