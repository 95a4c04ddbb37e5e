#include "burnish/mesh/bake/gutter.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr std::uint32_t kNoRow = ~0u;

// In every column the row of the nearest covered texel, the upper of two; kNoRow where it is farther than `padding`.
std::vector<std::uint32_t> nearest_rows(const ByteImage& covered, int padding) {
  const std::size_t w = covered.width, h = covered.height;
  std::vector<std::uint32_t> nearest(w * h, kNoRow);
  parallel_for_chunks(w, 64, [&](std::size_t begin, std::size_t end, std::size_t) {
    const auto walk = [&](bool down) {
      std::vector<std::uint32_t> last(end - begin, kNoRow);
      for (std::size_t i = 0; i < h; i++) {
        const std::uint32_t y = std::uint32_t(down ? i : h - 1 - i);
        for (std::size_t x = begin; x < end; x++) {
          std::uint32_t& covered_row = last[x - begin];
          if (covered.data[y * w + x]) covered_row = y;
          if (covered_row == kNoRow) continue;
          const std::uint32_t distance = down ? y - covered_row : covered_row - y;
          std::uint32_t& best = nearest[y * w + x];
          if (distance <= std::uint32_t(padding) && (best == kNoRow || distance < y - best)) best = covered_row;
        }
      }
    };
    walk(true);
    walk(false);
  });
  return nearest;
}

}  // namespace

std::vector<std::uint32_t> gutter_sources(const ByteImage& covered, int padding) {
  const int w = covered.width, h = covered.height;
  const std::vector<std::uint32_t> rows = nearest_rows(covered, padding);
  std::vector<std::uint32_t> sources(covered.texels(), kNoSource);
  const std::int64_t farthest = std::int64_t(padding) * padding;
  parallel_for(h, [&](std::size_t y) {
    const std::uint32_t* row = rows.data() + y * w;
    for (int x = 0; x < w; x++) {
      // Squared distance, then row, then column of the best so far.
      std::tuple<std::int64_t, std::uint32_t, int> best{farthest + 1, 0, 0};
      for (int dx = 0; dx < w && std::int64_t(dx) * dx <= std::min(std::get<0>(best), farthest); dx++)
        for (const int at : {x - dx, x + dx}) {
          if (at < 0 || at >= w || row[at] == kNoRow) continue;
          const std::int64_t dy = std::int64_t(y) - row[at];
          best = std::min(best, {std::int64_t(dx) * dx + dy * dy, row[at], at});
        }
      if (std::get<0>(best) <= farthest)
        sources[y * w + x] = std::uint32_t(std::get<1>(best) * std::size_t(w) + std::get<2>(best));
    }
  });
  return sources;
}

}  // namespace burnish
