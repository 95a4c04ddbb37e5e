// A blue-noise threshold tile by void-and-cluster (Ulichney, "The void-and-cluster method for dither array generation",
// 1993).
#pragma once

#include <cstdint>
#include <vector>

namespace burnish {

constexpr int kBlueNoiseSide = 64;

// Ranks 0 … 4095, each once, row by row; the tile repeats without a seam. Made once, always the same.
const std::vector<std::uint16_t>& blue_noise_tile();

}  // namespace burnish
