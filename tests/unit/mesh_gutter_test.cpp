#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "burnish/mesh/bake/gutter.h"
#include "on_threads.h"

namespace burnish {
namespace {

// The definition: every covered texel is tried.
std::uint32_t nearest(const ByteImage& covered, int x, int y, int padding) {
  std::tuple<long, int, int> best{long(padding) * padding + 1, 0, 0};
  for (int row = 0; row < covered.height; row++)
    for (int column = 0; column < covered.width; column++)
      if (*covered.at(column, row)) {
        const long dx = column - x, dy = row - y;
        best = std::min(best, {dx * dx + dy * dy, row, column});
      }
  const auto [distance, row, column] = best;
  return distance > long(padding) * padding ? kNoSource : std::uint32_t(row * covered.width + column);
}

TEST(Gutter, TakesTheNearestTheTopmostTheLeftmost) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; round++) {
    ByteImage covered(1 + int(random() % 40), 1 + int(random() % 40));
    const unsigned one_in = 2 + unsigned(round) * 4;
    for (std::uint8_t& c : covered.data) c = random() % one_in == 0 ? std::uint8_t(1 + random() % 255) : 0;
    for (const int padding : {0, 1, 3, 8, 1000}) {
      const std::vector<std::uint32_t> sources = gutter_sources(covered, padding);
      for (int y = 0; y < covered.height; y++)
        for (int x = 0; x < covered.width; x++)
          ASSERT_EQ(sources[std::size_t(y) * covered.width + x], nearest(covered, x, y, padding))
              << x << "," << y << " of " << covered.width << "x" << covered.height << " with padding " << padding;
    }
  }
}

TEST(Gutter, FillsWhatHasASource) {
  ByteImage covered(5, 1);
  covered.data = {0, 0, 1, 0, 0};
  std::vector<int> values{1, 2, 3, 4, 5};
  fill_gutter(gutter_sources(covered, 1), values);
  EXPECT_EQ(values, (std::vector<int>{1, 3, 3, 3, 5}));
  fill_gutter(gutter_sources(ByteImage(5, 1), 100), values);
  EXPECT_EQ(values, (std::vector<int>{1, 3, 3, 3, 5}));
}

TEST(Gutter, IsTheSameOnAnyNumberOfThreads) {
  std::mt19937 random(5);
  ByteImage covered(300, 200);
  for (std::uint8_t& c : covered.data) c = random() % 50 == 0;
  const auto sources = [&] { return gutter_sources(covered, 12); };
  EXPECT_EQ(on_threads(4, sources), on_threads(1, sources));
}

}  // namespace
}  // namespace burnish
