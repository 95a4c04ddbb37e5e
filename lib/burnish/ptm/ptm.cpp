#include "burnish/ptm/ptm.h"

#include <algorithm>

namespace burnish {

const char* name(PtmType type) { return type == PtmType::kLrgb ? "lrgb" : "rgb"; }

std::array<float, 3> Ptm::lit(std::size_t texel, float u, float v) const {
  const auto polynomial = [&](std::size_t i) {
    PtmCoefficients<float> a;
    std::copy_n(coefficients.data() + i * kPtmTerms, kPtmTerms, a.begin());
    return evaluate(a, u, v);
  };
  if (type == PtmType::kRgb) return {polynomial(texel * 3), polynomial(texel * 3 + 1), polynomial(texel * 3 + 2)};
  const float light = polynomial(texel) / 255;
  const float* c = colour.data() + texel * 3;
  return {c[0] * light, c[1] * light, c[2] * light};
}

Ptm decoded(const PtmBytes& bytes) {
  Ptm out{bytes, {}, {bytes.colour.begin(), bytes.colour.end()}};
  out.coefficients.resize(bytes.coefficients.size());
  for (std::size_t i = 0; i < out.coefficients.size(); i++) {
    const std::size_t k = i % kPtmTerms;
    out.coefficients[i] = float((bytes.coefficients[i] - bytes.bias[k]) * bytes.scale[k]);
  }
  return out;
}

}  // namespace burnish
