// Which elements of an array are equal: files repeat positions, normals and texture coordinates as they please.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

inline auto weld_key(const Vec3d& v) { return std::tie(v.x, v.y, v.z); }
inline auto weld_key(const Vec2d& v) { return std::tie(v.x, v.y); }
inline const Corners& weld_key(const Corners& c) { return c; }

// For each element the index of the first that equals it. −0 equals 0; there is no NaN.
template <typename T>
std::vector<std::uint32_t> weld(const std::vector<T>& values) {
  std::vector<std::uint32_t> order(values.size()), first(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = weld_key(values[a]), kb = weld_key(values[b]);
    return ka < kb || (!(kb < ka) && a < b);
  });
  for (std::size_t i = 0; i < order.size(); i++) {
    const bool repeats = i > 0 && weld_key(values[order[i - 1]]) == weld_key(values[order[i]]);
    first[order[i]] = repeats ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace burnish
