// Sizes of mip levels, and the weights with which texels of one level make a texel of the next.
//
// Level sizes are ⌊n/2⌋, at least 1. An even side of 2m texels averages pairs. An odd side of 2m + 1 makes m texels,
// each (2m + 1)/m of the finer texels wide: texel i covers the finer 2i, 2i+1, 2i+2 with weights m−i, m, i+1 out of 2m
// + 1, so that each finer texel counts the same in the end and no texel shifts. Weights are integers: ties are exact.
// Source: Guthe & Heckbert, "Non-power-of-two mipmapping" (NVIDIA, 2005).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "burnish/core/error.h"

namespace burnish {

inline int next_level_size(int n) { return std::max(1, n / 2); }

// Of a side of n texels in the base.
inline int level_size(int n, int level) { return std::max(1, n >> level); }

inline int level_count(int width, int height) {
  int n = 1;
  for (; width > 1 || height > 1; n++) width = next_level_size(width), height = next_level_size(height);
  return n;
}

// How many levels, with the base, are to be made of those there are: all where 0 is asked for. kUsage for more.
inline int levels_to_make(int width, int height, int asked) {
  const int all = level_count(width, height);
  if (asked >= 0 && asked <= all) return asked == 0 ? all : asked;
  throw Error(ErrorKind::kUsage, "levels: expected 1 to " + std::to_string(all) + " for " + std::to_string(width) +
                                     "x" + std::to_string(height) + " texels, got " + std::to_string(asked));
}

// Texels first … first + count − 1 of the finer level, along one side; their weights sum to `total`. Products of two
// sides' weights are beyond an int where both sides are odd and long.
struct MipTaps {
  int first, count;
  std::int64_t total, weight[3];
};

inline MipTaps mip_taps(int finer_size, int i) {
  if (finer_size == 1) return {0, 1, 1, {1, 0, 0}};
  if (finer_size % 2 == 0) return {2 * i, 2, 2, {1, 1, 0}};
  const int m = finer_size / 2;
  return {2 * i, 3, finer_size, {m - i, m, i + 1}};
}

}  // namespace burnish
