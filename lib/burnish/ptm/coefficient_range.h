// What a map's coefficients span, of all its polynomials together.
#pragma once

#include <limits>
#include <span>

#include "burnish/ptm/ptm_rows.h"

namespace burnish {

class CoefficientRange {
 public:
  PtmCoefficients<double> least, most;

  CoefficientRange() {  // of none
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  // Of polynomials, six after six. kMalformed where one is no finite number.
  explicit CoefficientRange(std::span<const float> coefficients);
  CoefficientRange& operator+=(const CoefficientRange& other);
};

// Reads all rows, in parallel.
CoefficientRange coefficient_range(const PtmRows& rows);

}  // namespace burnish
