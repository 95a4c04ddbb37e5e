// A polynomial texture map in memory: a polynomial of the light's direction a texel (basis.h), or one each for red,
// green and blue. Values are those of 8-bit photographs, 0 … 255. Row 0 is the top row.
//
//   LRGB   colour_c · L(u, v) / 255
//   RGB    L_c(u, v)
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "burnish/ptm/basis.h"

namespace burnish {

enum class PtmType { kLrgb, kRgb };
const char* name(PtmType type);  // "lrgb", "rgb"

struct PtmShape {
  PtmType type = PtmType::kLrgb;
  int width = 0, height = 0;

  std::size_t texels() const { return std::size_t(width) * height; }
  int polynomials() const { return type == PtmType::kLrgb ? 1 : 3; }  // a texel
  int colours() const { return type == PtmType::kLrgb ? 3 : 0; }      // a texel
};

struct Ptm : PtmShape {
  std::vector<float> coefficients;  // six of each polynomial of a texel
  std::vector<float> colour;        // R, G, B of a texel, where there are colours

  // Of one texel; not clipped.
  std::array<float, 3> lit(std::size_t texel, float u, float v) const;
};

// The same in bytes, as .ptm files hold it: a = (raw − bias) · scale, with one scale and bias for a term throughout.
struct PtmBytes : PtmShape {
  PtmCoefficients<double> scale{1, 1, 1, 1, 1, 1};
  PtmCoefficients<int> bias{};                     // any
  std::vector<std::uint8_t> coefficients, colour;  // as Ptm's
};
Ptm decoded(const PtmBytes& bytes);

// Whether floats hold all that bytes of this scale and bias stand for.
template <typename Bias>
bool floats_hold(const PtmCoefficients<double>& scale, const PtmCoefficients<Bias>& bias) {
  for (int k = 0; k < kPtmTerms; k++)
    for (const int raw : {0, 255})
      if (!(std::abs((raw - bias[k]) * scale[k]) <= std::numeric_limits<float>::max())) return false;
  return true;
}

}  // namespace burnish
