// How many rows of an image are worked on at once.
#pragma once

#include <algorithm>
#include <cstddef>

namespace burnish {

// Multiples of 64, which end where strips and tiles of the usual sizes end: 2 MiB of one channel of floats, where 64
// rows are not more.
inline int band_rows(int width) {
  return int(std::clamp<std::size_t>((2 << 20) / (std::size_t(width) * 4) / 64 * 64, 64, 4096));
}

}  // namespace burnish
