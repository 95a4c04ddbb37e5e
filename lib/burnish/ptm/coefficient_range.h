// What a map's coefficients span, of all its polynomials together.
#pragma once

#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct CoefficientRange {
  PtmCoefficients<double> least{}, most{};
};

// Reads all rows, in parallel.
CoefficientRange coefficient_range(const PtmRows& rows);

}  // namespace burnish
