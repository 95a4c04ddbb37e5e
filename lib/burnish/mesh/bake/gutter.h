// Gutters: what a map holds just outside its charts, so that bilinear lookups and mip levels at a chart's border find
// the chart's own values there.
#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/image.h"

namespace burnish {

inline constexpr std::uint32_t kNoSource = ~0u;

// The texel (row · width + column) whose value each texel takes: a covered texel its own; any other that of the nearest
// covered one, by the Euclidean distance of centres, within `padding` texels; kNoSource where there is none. Of equally
// near ones the topmost, then the leftmost. `covered` has one channel, not 0 where a texel is covered, and fewer than
// 2³² texels. Runs in parallel over columns, then rows, each on its own.
std::vector<std::uint32_t> gutter_sources(const ByteImage& covered, int padding);

// Gives every texel what its source holds.
template <typename T>
void fill_gutter(const std::vector<std::uint32_t>& sources, std::vector<T>& values) {
  for (std::size_t i = 0; i < values.size(); i++)
    if (sources[i] != kNoSource) values[i] = values[sources[i]];
}

}  // namespace burnish
