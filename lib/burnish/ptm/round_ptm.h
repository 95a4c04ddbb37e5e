// A map of floats rounded to the bytes of files: over the range of its own coefficients, of all polynomials together,
// each texel's six so that its light changes least (coefficient_rounding.h). Colours are rounded to whole numbers, and
// what that changes of a texel's brightness is made up for by its light.
#pragma once

#include <array>

#include "burnish/ptm/ptm_rows.h"

namespace burnish {

// All bytes, 9 or 18 a texel, in memory; `rows` are read in bands, twice. `normal`: G (light_matrix.h). kMalformed
// where a coefficient is no finite number.
PtmBytes rounded(const PtmRows& rows, const std::array<PtmCoefficients<double>, kPtmTerms>& normal);

}  // namespace burnish
