#include "burnish/core/mip.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace burnish {
namespace {

TEST(Mip, LevelSizesHalveDownToOne) {
  EXPECT_EQ(next_level_size(1), 1);
  EXPECT_EQ(next_level_size(2), 1);
  EXPECT_EQ(next_level_size(3), 1);
  EXPECT_EQ(next_level_size(7), 3);
  EXPECT_EQ(next_level_size(4096), 2048);
  EXPECT_EQ(level_count(1, 1), 1);
  EXPECT_EQ(level_count(2, 1), 2);
  EXPECT_EQ(level_count(3, 3), 2);
  EXPECT_EQ(level_count(5, 17), 5);
  EXPECT_EQ(level_count(4096, 4096), 13);
}

TEST(Mip, TapsStayInsideAndSumToTheirTotal) {
  for (int n = 1; n <= 300; n++)
    for (int i = 0; i < next_level_size(n); i++) {
      const MipTaps taps = mip_taps(n, i);
      ASSERT_GE(taps.first, 0) << "size " << n << " texel " << i;
      ASSERT_LE(taps.first + taps.count, n) << "size " << n << " texel " << i;
      ASSERT_LE(taps.count, 3);
      int sum = 0;
      for (int k = 0; k < taps.count; k++) {
        ASSERT_GE(taps.weight[k], 0) << "size " << n << " texel " << i;
        sum += taps.weight[k];
      }
      ASSERT_EQ(sum, taps.total) << "size " << n << " texel " << i;
    }
}

// Beyond 2^31 texels, both sides odd.
TEST(Mip, WeightsOfLargeImagesMultiply) {
  const MipTaps t = mip_taps(65535, 5);
  EXPECT_EQ(t.total * t.total, std::int64_t(65535) * 65535);
  std::int64_t sum = 0;
  for (int j = 0; j < t.count; j++)
    for (int i = 0; i < t.count; i++) sum += t.weight[i] * t.weight[j];
  EXPECT_EQ(sum, t.total * t.total);
}

TEST(Mip, EveryFinerTexelCountsTheSame) {
  for (int n = 1; n <= 300; n++) {
    const int m = next_level_size(n);
    std::vector<long> covered(n);
    int total = 0;
    for (int i = 0; i < m; i++) {
      const MipTaps taps = mip_taps(n, i);
      total = taps.total;
      for (int k = 0; k < taps.count; k++) covered[taps.first + k] += taps.weight[k];
    }
    // All totals of a level are equal, so m totals are shared among n texels.
    for (int x = 0; x < n; x++) ASSERT_EQ(covered[x] * n, long(m) * total) << "size " << n << " finer texel " << x;
  }
}

TEST(Mip, CentreOfMassIsTheCentreOfTheCoarserTexel) {
  for (int n = 2; n <= 99; n++) {
    const int m = next_level_size(n);
    for (int i = 0; i < m; i++) {
      const MipTaps taps = mip_taps(n, i);
      double mass = 0;
      for (int k = 0; k < taps.count; k++) mass += taps.weight[k] * (taps.first + k + 0.5);
      // A box of width n/m weighted by overlap keeps the centre up to what whole texels can show.
      EXPECT_NEAR(mass / taps.total, (i + 0.5) * n / m, 0.25) << "size " << n << " texel " << i;
    }
  }
}

}  // namespace
}  // namespace burnish
