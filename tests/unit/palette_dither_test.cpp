#include <gtest/gtest.h>

#include <complex>

#include "burnish/palette/blue_noise.h"
#include "burnish/palette/dither.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::Random;
using Regions = std::vector<std::uint16_t>;

enum class Kind { kDiffusion, kDots };

// The whole of a map of at most kDotBandRows rows.
std::vector<std::uint16_t> dither(Kind kind, const std::vector<Vec3f>& entries, const std::vector<EntryRange>& ranges,
                                  int width, const std::vector<Vec3f>& normals, const Regions& region,
                                  double amount = 1) {
  std::vector<const EntryRange*> pointers;
  for (const EntryRange& r : ranges) pointers.push_back(&r);
  std::vector<std::uint16_t> out(normals.size());
  const int rows = int(normals.size()) / width;
  if (kind == Kind::kDots) {
    diffuse_dots(entries, pointers, width, rows, normals.data(), region.data(), amount, out.data());
    return out;
  }
  ErrorDiffusion diffusion(entries, pointers, width, amount);
  for (int y = 0; y < rows; y++) {
    const std::uint16_t* here = region.data() + y * width;
    diffusion.row(normals.data() + y * width, here, y + 1 < rows ? here + width : nullptr, out.data() + y * width);
  }
  return out;
}

std::vector<EntryRange> one_range(const std::vector<Vec3f>& entries) { return {{0, NearestEntry(entries)}}; }

// Normals that turn slowly, and a palette too coarse for them.
std::vector<Vec3f> ramp(int width, int height) {
  std::vector<Vec3f> out;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      out.push_back(Vec3f(normalized(Vec3d{0.9 * x / width - 0.4, 0.5 * y / height - 0.2, 1})));
  return out;
}

std::vector<Vec3f> upper_palette(int n) {
  std::vector<Vec3f> out;
  for (const Vec3f& v : testing::fibonacci_sphere(2 * n))
    if (v.z > 0) out.push_back(v);
  return out;
}

// RMS angle between the means of blocks of 4 × 4 texels before and after.
double block_rms_deg(const std::vector<Vec3f>& entries, int width, const std::vector<Vec3f>& normals,
                     const std::vector<std::uint16_t>& index) {
  const int height = int(normals.size()) / width;
  double squares = 0;
  int blocks = 0;
  for (int by = 0; by + 4 <= height; by += 4)
    for (int bx = 0; bx + 4 <= width; bx += 4, blocks++) {
      Vec3d wanted, got;
      for (int y = by; y < by + 4; y++)
        for (int x = bx; x < bx + 4; x++)
          wanted += Vec3d(normals[y * width + x]), got += Vec3d(entries[index[y * width + x]]);
      const double a = degrees(angle_rad(wanted, got));
      squares += a * a;
    }
  return std::sqrt(squares / blocks);
}

class PaletteDither : public ::testing::TestWithParam<Kind> {};

TEST_P(PaletteDither, KeepsTheMeansOfBlocks) {
  const int width = 128;
  const std::vector<Vec3f> normals = ramp(width, 128), entries = upper_palette(60);
  const std::vector<EntryRange> ranges = one_range(entries);
  const Regions region(normals.size());
  const double plain = block_rms_deg(entries, width, normals,
                                     dither(GetParam(), entries, ranges, width, normals, region, 0)),
               half = block_rms_deg(entries, width, normals,
                                    dither(GetParam(), entries, ranges, width, normals, region, 0.5)),
               whole = block_rms_deg(entries, width, normals,
                                     dither(GetParam(), entries, ranges, width, normals, region, 1));
  EXPECT_LT(whole, 0.3 * plain);
  EXPECT_LT(half, plain);
  EXPECT_LT(whole, half);
}

// A constant normal between three entries: the mean over a large part tends to it.
TEST_P(PaletteDither, DoesNotDrift) {
  const std::vector<Vec3f> entries = upper_palette(40);
  const Vec3f n = Vec3f(normalized(Vec3d{0.31, -0.22, 0.9}));
  const std::vector<Vec3f> normals(128 * 128, n);
  const auto index = dither(GetParam(), entries, one_range(entries), 128, normals, Regions(normals.size()));
  Vec3d sum;
  for (const std::uint16_t i : index) sum += Vec3d(entries[i]);
  EXPECT_LT(degrees(angle_rad(sum, Vec3d(n))), 0.3);
}

TEST_P(PaletteDither, NoAmountIsTheNearestEntry) {
  const std::vector<Vec3f> normals = testing::bumpy_normals(90, 70), entries = upper_palette(50);
  const auto index = dither(GetParam(), entries, one_range(entries), 90, normals, Regions(normals.size()), 0);
  for (std::size_t i = 0; i < normals.size(); i++)
    ASSERT_EQ(index[i], testing::brute_nearest(entries, normals[i])) << i;
}

TEST_P(PaletteDither, WhatThePaletteHoldsIsLeftAlone) {
  const std::vector<Vec3f> entries = upper_palette(50);
  Random random(2);
  std::vector<Vec3f> normals;
  std::vector<int> expected;
  for (int i = 0; i < 64 * 64; i++) expected.push_back(random.below(50)), normals.push_back(entries[expected.back()]);
  const auto index = dither(GetParam(), entries, one_range(entries), 64, normals, Regions(normals.size()));
  for (std::size_t i = 0; i < normals.size(); i++) ASSERT_EQ(index[i], expected[i]) << i;
}

TEST_P(PaletteDither, EntriesOfTheRegionsRangeOnly) {
  const std::vector<Vec3f> entries = testing::fibonacci_sphere(60);
  std::vector<EntryRange> ranges;
  for (int first : {0, 20, 40}) ranges.push_back({first, NearestEntry(std::span(entries).subspan(first, 20))});
  const std::vector<Vec3f> normals = testing::bumpy_normals(100, 80);
  Random random(3);
  Regions region(normals.size());
  for (std::uint16_t& r : region) r = std::uint16_t(random.below(3));
  const auto index = dither(GetParam(), entries, ranges, 100, normals, region);
  for (std::size_t i = 0; i < index.size(); i++) ASSERT_EQ(index[i] / 20, region[i]) << i;
}

// Two regions that share one range, as the masked and unmasked texels of a material do: what is on one side
// of the border changes nothing on the other.
TEST_P(PaletteDither, NoErrorCrossesABorder) {
  const int width = 70, height = 60;
  const std::vector<Vec3f> entries = upper_palette(30);
  const NearestEntry nearest(entries);
  const std::vector<EntryRange> ranges{{0, nearest}, {0, nearest}};
  Regions region(std::size_t(width) * height);
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) region[y * width + x] = std::uint16_t((x + y / 2) / 17 % 2 ^ (y > 40));
  const std::vector<Vec3f> one = ramp(width, height);
  std::vector<Vec3f> other = one;
  for (std::size_t i = 0; i < other.size(); i++)
    if (region[i] == 1) other[i] = Vec3f(normalized(Vec3d{-0.3, 0.7, 0.5}));
  const auto a = dither(GetParam(), entries, ranges, width, one, region),
             b = dither(GetParam(), entries, ranges, width, other, region);
  int differ = 0;
  for (std::size_t i = 0; i < a.size(); i++) {
    if (region[i] == 0) ASSERT_EQ(a[i], b[i]) << "column " << i % width << ", row " << i / width;
    else differ += a[i] != b[i];
  }
  EXPECT_GT(differ, 0);
}

INSTANTIATE_TEST_SUITE_P(Both, PaletteDither, ::testing::Values(Kind::kDiffusion, Kind::kDots),
                         [](const auto& kind) { return kind.param == Kind::kDiffusion ? "Diffusion" : "Dots"; });

TEST(PaletteDiffusion, AMapOneTexelWideOrHigh) {
  const std::vector<Vec3f> entries = upper_palette(30), normals = ramp(64, 1);
  for (const Kind kind : {Kind::kDiffusion, Kind::kDots})
    for (const int width : {1, 64}) {
      const auto index = dither(kind, entries, one_range(entries), width, normals, Regions(64));
      for (const std::uint16_t i : index) EXPECT_LT(i, entries.size());
    }
}

TEST(PaletteBlueNoise, IsAPermutation) {
  const std::vector<std::uint16_t>& tile = blue_noise_tile();
  ASSERT_EQ(tile.size(), 4096u);
  std::vector<int> times(4096);
  for (const std::uint16_t rank : tile) {
    ASSERT_LT(rank, 4096);
    times[rank]++;
  }
  for (int rank = 0; rank < 4096; rank++) ASSERT_EQ(times[rank], 1) << rank;
}

// Energy of the frequencies up to 8 cycles a tile; white noise has as much as in any band as large.
double low_energy(const std::vector<double>& tile) {
  constexpr int kSide = kBlueNoiseSide;
  double energy = 0;
  int frequencies = 0;
  for (int v = -8; v <= 8; v++)
    for (int u = -8; u <= 8; u++) {
      if (u * u + v * v > 64 || (u == 0 && v == 0)) continue;
      std::complex<double> sum;
      for (int y = 0; y < kSide; y++)
        for (int x = 0; x < kSide; x++) sum += std::polar(tile[y * kSide + x], -2 * kPi * (u * x + v * y) / kSide);
      energy += std::norm(sum), frequencies++;
    }
  return energy / frequencies;
}

TEST(PaletteBlueNoise, HasLittleEnergyAtLowFrequencies) {
  std::vector<double> blue(4096), white(4096);
  for (int i = 0; i < 4096; i++) blue[i] = blue_noise_tile()[i];
  white = blue;
  Random random(4);
  for (int i = 4095; i > 0; i--) std::swap(white[i], white[random.below(i + 1)]);
  EXPECT_LT(low_energy(blue), 0.02 * low_energy(white));
}

TEST(PaletteBlueNoise, EveryThresholdIsSpreadEvenly) {
  const std::vector<std::uint16_t>& tile = blue_noise_tile();
  for (const int below : {128, 512, 2048, 3584})
    for (int by = 0; by < 64; by += 16)
      for (int bx = 0; bx < 64; bx += 16) {
        int set = 0;
        for (int y = by; y < by + 16; y++)
          for (int x = bx; x < bx + 16; x++) set += tile[y * 64 + x] < below;
        EXPECT_NEAR(set, below / 16.0, 4 + 0.03 * below / 16.0)
            << "ranks below " << below << " in the block at " << bx << ", " << by;
      }
}

}  // namespace
}  // namespace burnish
