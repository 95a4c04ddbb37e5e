#include "burnish/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace burnish {
namespace {

// Values of very different magnitude, so that any other order of adding gives other bits.
double term(std::size_t i) { return std::sin(double(i) * 12.9898) * std::pow(10.0, double(i % 17) - 8); }

double sum_with(int threads, std::size_t count, std::size_t grain) {
  const ThreadLimit limit(threads);
  return parallel_sum<double>(count, grain, [](std::size_t begin, std::size_t end) {
    double s = 0;
    for (std::size_t i = begin; i < end; i++) s += term(i);
    return s;
  });
}

TEST(Parallel, SumHasTheSameBitsForAnyThreadCount) {
  for (const std::size_t count :
       {std::size_t(0), std::size_t(1), std::size_t(999), std::size_t(1000), std::size_t(123457)}) {
    const double one = sum_with(1, count, 1000);
    for (int threads : {2, 8, 0})
      for (int repeat = 0; repeat < 5; repeat++) {
        const double many = sum_with(threads, count, 1000);
        EXPECT_EQ(std::memcmp(&one, &many, sizeof one), 0) << count << " terms, " << threads << " threads";
      }
  }
}

TEST(Parallel, ChunksCoverEachIndexOnce) {
  for (const std::size_t count :
       {std::size_t(0), std::size_t(1), std::size_t(64), std::size_t(65), std::size_t(1000)}) {
    std::vector<int> seen(count);
    parallel_for_chunks(count, 64, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
      EXPECT_EQ(begin, chunk * 64);
      EXPECT_LE(end, count);
      for (std::size_t i = begin; i < end; i++) seen[i]++;
    });
    for (std::size_t i = 0; i < count; i++) EXPECT_EQ(seen[i], 1) << "index " << i << " of " << count;
  }
}

TEST(Parallel, LimitEndsWithItsScope) {
  const auto active = [] { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); };
  const std::size_t before = active();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(active(), 1u);
  }
  EXPECT_EQ(active(), before);
}

}  // namespace
}  // namespace burnish
