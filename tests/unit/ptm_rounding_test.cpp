#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "burnish/ptm/coefficient_rounding.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {
namespace {

using Bytes = PtmCoefficients<std::uint8_t>;

std::array<PtmCoefficients<double>, kPtmTerms> normal_of_a_dome() {
  std::vector<Vec3d> lights;
  for (int i = 0; i < 40; i++) {
    const double z = 0.21 + 0.785 * (i + 0.5) / 40, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    lights.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return light_matrix(lights, 0, "dome.lp").normal;
}

const ByteRange kRange = byte_range({-60, -60, -20, -50, -50, 0}, {15, 15, 20, 50, 50, 200});

std::vector<PtmCoefficients<float>> some_coefficients(int count) {
  std::mt19937 random(7);
  std::vector<PtmCoefficients<float>> out(count);
  for (auto& a : out)
    for (int k = 0; k < kPtmTerms; k++)
      a[k] = float((20 + 215 * double(random()) / 4294967296.0 - kRange.bias[k]) * kRange.scale[k]);
  return out;
}

Bytes each_by_itself(const PtmCoefficients<float>& a) {
  Bytes raw;
  for (int k = 0; k < kPtmTerms; k++) raw[k] = std::uint8_t(std::floor(a[k] / kRange.scale[k] + kRange.bias[k] + 0.5));
  return raw;
}

TEST(CoefficientRounding, LosesLessThanRoundingEachByItself) {
  const CoefficientRounding rounding(kRange, normal_of_a_dome());
  double together = 0, each = 0;
  for (const auto& a : some_coefficients(2000)) {
    const double one = rounding.squared_error(a, rounding.rounded(a)),
                 other = rounding.squared_error(a, each_by_itself(a));
    EXPECT_LE(one, other * (1 + 1e-9));
    together += one, each += other;
  }
  EXPECT_LT(together, 0.6 * each);
}

// No step of up to two in every coefficient at once makes it much better.
TEST(CoefficientRounding, IsNearTheNearestOfAll) {
  const CoefficientRounding rounding(kRange, normal_of_a_dome());
  double found = 0, best = 0;
  for (const auto& a : some_coefficients(40)) {
    const Bytes raw = rounding.rounded(a);
    double least = rounding.squared_error(a, raw);
    found += least;
    for (int code = 0; code < 15625; code++) {
      Bytes tried = raw;
      for (int k = 0, rest = code; k < kPtmTerms; k++, rest /= 5) tried[k] = std::uint8_t(raw[k] + rest % 5 - 2);
      least = std::min(least, rounding.squared_error(a, tried));
    }
    best += least;
  }
  EXPECT_LT(found, 1.1 * best);
}

TEST(CoefficientRounding, WhatBytesHoldComesBack) {
  const CoefficientRounding rounding(kRange, normal_of_a_dome());
  for (int i = 0; i < 256; i += 15) {
    const Bytes raw{std::uint8_t(i), 3, 250, std::uint8_t(255 - i), 0, 255};
    PtmCoefficients<float> a;
    for (int k = 0; k < kPtmTerms; k++) a[k] = float((raw[k] - kRange.bias[k]) * kRange.scale[k]);
    EXPECT_EQ(rounding.rounded(a), raw);
  }
}

// Other programs scale by 0 what is 0 all over: it must not spoil the five others.
TEST(CoefficientRounding, AScaleOfZeroLeavesTheOthersAlone) {
  for (int zero = 0; zero < kPtmTerms; zero++) {
    ByteRange range{{0.25, 0.3, 0.2, 0.5, 0.4, 0.6}, {260, 255, 127, 120, 130, -70}};
    range.scale[zero] = 0;
    const CoefficientRounding rounding(range, uniform_normal_matrix());
    PtmCoefficients<std::uint8_t> raw{7, 30, 100, 128, 200, 250};
    PtmCoefficients<float> a;
    for (int k = 0; k < kPtmTerms; k++) a[k] = float((raw[k] - range.bias[k]) * range.scale[k]);
    PtmCoefficients<std::uint8_t> got = rounding.rounded(a);
    got[zero] = raw[zero];
    EXPECT_EQ(got, raw) << zero;
  }
}

TEST(ByteRange, HoldsItsEndsConstantsAndZero) {
  const ByteRange r = byte_range({-10, 5, 3, -4, 0, 1e6}, {245, 5.1, 3, -4, 0, 1e6 + 1e-3});
  const double least[] = {-10, 5, 3, -4, 0, 1e6}, most[] = {245, 5.1, 3, -4, 0, 1e6 + 1e-3};
  for (int k = 0; k < kPtmTerms; k++)
    for (const double a : {least[k], most[k]}) {
      const double raw = std::floor(a / r.scale[k] + r.bias[k] + 0.5);
      EXPECT_GE(raw, 0) << k;
      EXPECT_LE(raw, 255) << k;
      EXPECT_LE(std::abs((raw - r.bias[k]) * r.scale[k] - a), std::abs(0.51 * r.scale[k])) << k;
    }
  EXPECT_EQ((1 - r.bias[2]) * r.scale[2], 3);
  EXPECT_EQ((0 - r.bias[3]) * r.scale[3], -4);
  for (const double s : r.scale) EXPECT_GT(s, 0);
}

}  // namespace
}  // namespace burnish
