// The rows of a map that is baked over a mesh.
#pragma once

#include <algorithm>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

// The sum of row(y) over all rows, which run in parallel; added in their order. Progress is told between bands of them.
template <typename Stats, typename Row>
Stats sum_of_rows(int height, const Progress& progress, const Row& row) {
  constexpr int kBand = 64;
  Stats stats;
  for (int y = 0; y < height; y += kBand) {
    const int rows = std::min(kBand, height - y);
    stats += parallel_sum<Stats>(rows, 1, [&](std::size_t i, std::size_t) { return row(y + int(i)); });
    report_progress(progress, double(y + rows) / height);
  }
  return stats;
}

// kMalformed where the mesh covers no texel.
inline void require_cover(const Mesh& mesh, std::size_t covered_texels, int width, int height) {
  if (covered_texels == 0)
    throw file_error(ErrorKind::kMalformed, mesh.name,
                     "expected triangles with area in the map, got none that covers a texel of " +
                         std::to_string(width) + "x" + std::to_string(height));
}

}  // namespace burnish
