#include "burnish/ptm/round_ptm.h"

#include <algorithm>
#include <cmath>

#include "burnish/ptm/coefficient_range.h"
#include "burnish/ptm/coefficient_rounding.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {
namespace {

// Rows of a map with colours in whole numbers, the light scaled so that colour · light, rounding the colour from c to
// q, changes least: by qᵀc / qᵀq.
PtmBand with_whole_colours(const PtmRows& rows, std::size_t begin, std::size_t end) {
  PtmBand band(rows, int(begin), int(end - begin));
  float* a = band.coefficients.data();
  for (float* c = band.colour.data(); c != band.colour.data() + band.colour.size(); c += 3, a += kPtmTerms) {
    float with = 0, length2 = 0;
    for (int i = 0; i < 3; i++) {
      const float whole = std::clamp(std::floor(c[i] + 0.5f), 0.0f, 255.0f);
      with += whole * c[i], length2 += whole * whole;
      c[i] = whole;
    }
    if (with == length2) continue;
    const float scale = length2 > 0 ? with / length2 : 0;
    for (int k = 0; k < kPtmTerms; k++) a[k] *= scale;
  }
  return band;
}

}  // namespace

PtmBytes rounded(const PtmRows& rows, const std::array<PtmCoefficients<double>, kPtmTerms>& normal) {
  PtmBytes out{rows.shape(), {}, {}, {}, {}};
  out.coefficients.resize(out.texels() * out.polynomials() * kPtmTerms);
  out.colour.resize(out.texels() * out.colours());
  const std::size_t at_once = band_rows(rows.shape());
  const auto range_of = [&](std::size_t begin, std::size_t end) {
    return CoefficientRange(with_whole_colours(rows, begin, end).coefficients);
  };
  const CoefficientRange all = parallel_sum<CoefficientRange>(std::size_t(out.height), at_once, range_of);
  const ByteRange range = byte_range(all.least, all.most);
  out.scale = range.scale, out.bias = range.bias;
  const CoefficientRounding rounding(range, normal);
  parallel_for_chunks(std::size_t(out.height), at_once, [&](std::size_t begin, std::size_t end, std::size_t) {
    const PtmBand of = with_whole_colours(rows, begin, end);
    std::uint8_t* to = out.coefficients.data() + begin * out.width * out.polynomials() * kPtmTerms;
    rounding.round(of.coefficients.data(), of.coefficients.size() / kPtmTerms, to);
    std::ranges::transform(of.colour, out.colour.begin() + begin * out.width * out.colours(),
                           [](float c) { return std::uint8_t(c); });
  });
  return out;
}

}  // namespace burnish
