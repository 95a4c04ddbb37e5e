#include "burnish/ptm/coefficient_range.h"

#include <limits>

#include "burnish/ptm/ptm_band.h"

namespace burnish {

CoefficientRange coefficient_range(const PtmRows& rows) {
  CoefficientRange all;
  all.least.fill(std::numeric_limits<double>::infinity());
  all.most.fill(-std::numeric_limits<double>::infinity());
  const auto widen = [](CoefficientRange& range, const CoefficientRange& by) {
    for (int k = 0; k < kPtmTerms; k++) {
      range.least[k] = std::min(range.least[k], by.least[k]);
      range.most[k] = std::max(range.most[k], by.most[k]);
    }
  };
  const auto of_texel = [&](const PtmBand& band, std::size_t texel) {
    CoefficientRange range{band.polynomial(texel), band.polynomial(texel)};
    for (int i = 1; i < band.polynomials(); i++) widen(range, {band.polynomial(texel, i), band.polynomial(texel, i)});
    return range;
  };
  for_each_texel<CoefficientRange>(rows, of_texel,
                                   [&](int, const std::vector<CoefficientRange>& texels) {
                                     for (const CoefficientRange& range : texels) widen(all, range);
                                   },
                                   {});
  return all;
}

}  // namespace burnish
