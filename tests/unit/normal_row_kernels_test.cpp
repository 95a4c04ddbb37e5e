#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "burnish/normal/row_kernels.h"

namespace burnish::kernels {
namespace {

// Lengths about those of lanes and vectors.
constexpr int kCounts[] = {1, 2, 3, 7, 15, 16, 17, 31, 33, 100, 512};

TEST(NormalRowKernels, NormalsOfSlopesAreUnitAndStandOnTheirPlanes) {
  for (const int count : kCounts) {
    std::vector<float> u(count), v(count), x(count), y(count), z(count), tangents(count);
    for (int i = 0; i < count; i++) u[i] = 0.3f * float(i - count / 2), v[i] = 0.01f * float(i * i % 97);
    normals_of_slopes(u.data(), v.data(), 2.f, 3.f, count, {x.data(), y.data(), z.data()}, tangents.data());
    for (int i = 0; i < count; i++) {
      EXPECT_NEAR(x[i] * x[i] + y[i] * y[i] + z[i] * z[i], 1, 1e-6) << i << " of " << count;
      EXPECT_NEAR(x[i] + 2 * double(u[i]) * z[i], 0, 1e-6) << i << " of " << count;  // (1, 0, a)·n = 0
      EXPECT_NEAR(y[i] + 3 * double(v[i]) * z[i], 0, 1e-6) << i << " of " << count;
      EXPECT_NEAR(tangents[i], std::sqrt((1 - z[i]) / (1 + double(z[i]))), 3e-4) << i << " of " << count;
    }
  }
}

TEST(NormalRowKernels, TiltsAreTheAnglesOfTheirHalfTangents) {
  for (const int count : kCounts) {
    std::vector<float> tangents(count);
    double sum = 0;
    for (int i = 0; i < count; i++) {
      tangents[i] = float(i + 1) / float(count);
      sum += 2 * std::atan(double(tangents[i]));
    }
    const Tilts t = tilts(tangents.data(), count);
    EXPECT_NEAR(t.sum, sum, 2e-7 * count) << count;
    EXPECT_EQ(t.steepest, 1.f) << count;
  }
}

TEST(NormalRowKernels, TinyTiltsKeepTheirDigits) {
  const std::vector<float> u(20, 1e-6f), flat(20, 0.f);
  std::vector<float> x(20), y(20), z(20), tangents(20);
  normals_of_slopes(u.data(), flat.data(), 1.f, 1.f, 20, {x.data(), y.data(), z.data()}, tangents.data());
  EXPECT_NEAR(tilts(tangents.data(), 20).sum, 20e-6, 1e-11);
}

TEST(NormalRowKernels, WhatIsNoNumberShowsInTheSum) {
  for (const int count : {20, 16, 3})
    for (int at = 0; at < count; at++) {
      std::vector<float> tangents(count, 0.5f);
      tangents[at] = std::numeric_limits<float>::quiet_NaN();
      EXPECT_TRUE(std::isnan(tilts(tangents.data(), count).sum)) << at << " of " << count;
    }
}

TEST(NormalRowKernels, EncodesEveryTexelRoundedHalfUp) {
  for (const int count : kCounts) {
    std::vector<float> x(count), y(count), z(count);
    for (int i = 0; i < count; i++) {
      const Vec3d n = normalized(Vec3d{std::sin(i * 0.7), std::cos(i * 1.3), 0.2 + i % 5});
      x[i] = float(n.x), y[i] = float(n.y), z[i] = float(n.z);
    }
    std::vector<Vec3f> n(count);
    interleave({x.data(), y.data(), z.data()}, count, n.data());
    for (const float sign : {1.f, -1.f}) {
      std::vector<std::uint8_t> bytes(3 * count);
      std::vector<std::uint16_t> words(3 * count);
      std::vector<float> floats(3 * count);
      encode_biased(n.data(), count, sign, bytes.data());
      encode_biased(n.data(), count, sign, words.data());
      encode_biased(n.data(), count, sign, floats.data());
      for (int i = 0; i < 3 * count; i++) {
        const float c = i % 3 == 0 ? x[i / 3] : i % 3 == 1 ? sign * y[i / 3] : z[i / 3];
        EXPECT_EQ(bytes[i], int(std::floor((0.5f * c + 0.5f) * 255.f + 0.5f))) << i << " of " << count;
        EXPECT_EQ(words[i], int(std::floor((0.5f * c + 0.5f) * 65535.f + 0.5f))) << i << " of " << count;
        EXPECT_EQ(floats[i], 0.5f * c + 0.5f) << i << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace burnish::kernels
