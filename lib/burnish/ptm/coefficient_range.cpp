#include "burnish/ptm/coefficient_range.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {

CoefficientRange::CoefficientRange(std::span<const float> coefficients) : CoefficientRange() {
  for (std::size_t i = 0; i < coefficients.size(); i += kPtmTerms)
    for (int k = 0; k < kPtmTerms; k++) {
      const double a = coefficients[i + k];
      if (!std::isfinite(a)) throw Error(ErrorKind::kMalformed, "expected finite coefficients, got others");
      least[k] = std::min(least[k], a);
      most[k] = std::max(most[k], a);
    }
}

CoefficientRange& CoefficientRange::operator+=(const CoefficientRange& other) {
  for (int k = 0; k < kPtmTerms; k++) {
    least[k] = std::min(least[k], other.least[k]);
    most[k] = std::max(most[k], other.most[k]);
  }
  return *this;
}

CoefficientRange coefficient_range(const PtmRows& rows) {
  return parallel_sum<CoefficientRange>(
      std::size_t(rows.shape().height), band_rows(rows.shape()), [&](std::size_t begin, std::size_t end) {
        return CoefficientRange(PtmBand(rows, int(begin), int(end - begin)).coefficients);
      });
}

}  // namespace burnish
