// Noise from an integer hash, so that what is made of it is the same everywhere.
#pragma once

#include <cmath>
#include <cstdint>

#include "burnish/core/vec3.h"

namespace burnish {

// [0, 1), from four integers.
inline double hash(int a, int b, int c, int seed) {
  std::uint32_t h = std::uint32_t(a) * 0x9e3779b1u ^ std::uint32_t(b) * 0x85ebca77u ^ std::uint32_t(c) * 0xc2b2ae3du ^
                    std::uint32_t(seed) * 0x27d4eb2fu;
  h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u, h ^= h >> 15;
  return h / 4294967296.0;
}

// Value noise in space, [−1, 1]; with `period` it repeats along x and y.
inline double noise(Vec3d p, int seed, int period = 0) {
  const auto smooth = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const int x = int(std::floor(p.x)), y = int(std::floor(p.y)), z = int(std::floor(p.z));
  const double fx = smooth(p.x - x), fy = smooth(p.y - y), fz = smooth(p.z - z);
  const auto wrap = [&](int i) { return period ? ((i % period) + period) % period : i; };
  double sum = 0;
  for (int k = 0; k < 8; k++) {
    const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
    sum += (i ? fx : 1 - fx) * (j ? fy : 1 - fy) * (l ? fz : 1 - fz) * hash(wrap(x + i), wrap(y + j), z + l, seed);
  }
  return 2 * sum - 1;
}

inline double turbulence(Vec3d p, int octaves, int seed, int period = 0) {
  double sum = 0, amplitude = 0.5;
  for (int o = 0; o < octaves; o++, amplitude *= 0.5, p = p * 2.0, period *= 2)
    sum += amplitude * noise(p, seed + o, period);
  return sum;
}

}  // namespace burnish
