#include "burnish/ptm/round_ptm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/ptm/coefficient_rounding.h"

namespace burnish {
namespace {

constexpr std::size_t kBandTexels = 1 << 14;

struct Extent {
  PtmCoefficients<double> least, most;
  Extent() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  Extent& operator+=(const Extent& other) {
    for (int k = 0; k < kPtmTerms; k++) {
      least[k] = std::min(least[k], other.least[k]);
      most[k] = std::max(most[k], other.most[k]);
    }
    return *this;
  }
};

// Rows of a map, colours in whole numbers and the light scaled so that colour · light, rounding the colour from c to q,
// changes least: by qᵀc / qᵀq.
struct Band {
  std::vector<float> coefficients, colour;
  Band(const PtmRows& rows, std::size_t first, std::size_t count)
      : coefficients(count * rows.shape().width * rows.shape().polynomials() * kPtmTerms),
        colour(count * rows.shape().width * rows.shape().colours()) {
    rows.read(int(first), int(count), coefficients.data(), colour.data());
    float* a = coefficients.data();
    for (float* c = colour.data(); c != colour.data() + colour.size(); c += 3, a += kPtmTerms) {
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
  }
};

Extent extent(const Band& band) {
  Extent e;
  for (std::size_t i = 0; i < band.coefficients.size(); i += kPtmTerms)
    for (int k = 0; k < kPtmTerms; k++) {
      const float a = band.coefficients[i + k];
      if (!std::isfinite(a)) throw Error(ErrorKind::kMalformed, "expected finite coefficients, got others");
      e.least[k] = std::min<double>(e.least[k], a);
      e.most[k] = std::max<double>(e.most[k], a);
    }
  return e;
}

}  // namespace

PtmBytes rounded(const PtmRows& rows, const std::array<PtmCoefficients<double>, kPtmTerms>& normal) {
  PtmBytes out{rows.shape(), {}, {}, {}, {}};
  out.coefficients.resize(out.texels() * out.polynomials() * kPtmTerms);
  out.colour.resize(out.texels() * out.colours());
  const std::size_t band = std::max<std::size_t>(1, kBandTexels / out.width);
  const Extent all = parallel_sum<Extent>(
      out.height, band, [&](std::size_t begin, std::size_t end) { return extent(Band(rows, begin, end - begin)); });
  const ByteRange range = byte_range(all.least, all.most);
  out.scale = range.scale, out.bias = range.bias;
  const CoefficientRounding rounding(range, normal);
  parallel_for_chunks(out.height, band, [&](std::size_t begin, std::size_t end, std::size_t) {
    const Band of(rows, begin, end - begin);
    std::uint8_t* to = out.coefficients.data() + begin * out.width * out.polynomials() * kPtmTerms;
    rounding.round(of.coefficients.data(), of.coefficients.size() / kPtmTerms, to);
    std::ranges::transform(of.colour, out.colour.begin() + begin * out.width * out.colours(),
                           [](float c) { return std::uint8_t(c); });
  });
  return out;
}

}  // namespace burnish
