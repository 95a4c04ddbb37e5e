// The octahedral map: unit vectors to the square [−1,1]² and back (Meyer et al., "On floating-point normal vectors",
// 2010).
#pragma once

#include <cmath>
#include <cstdint>

#include "burnish/core/vec3.h"

namespace burnish {

struct Octahedral {
  double u, v;
};

inline Octahedral to_octahedral(Vec3d n) {
  const double s = 1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const double x = n.x * s, y = n.y * s;
  if (n.z >= 0) return {x, y};
  return {std::copysign(1 - std::abs(y), n.x), std::copysign(1 - std::abs(x), n.y)};
}

inline Vec3d from_octahedral(Octahedral o) {
  Vec3d n{o.u, o.v, 1 - std::abs(o.u) - std::abs(o.v)};
  if (n.z < 0) n = {std::copysign(1 - std::abs(o.v), o.u), std::copysign(1 - std::abs(o.u), o.v), n.z};
  return normalized(n);
}

// Integers of `bits` bits a coordinate. 0 is exact: the axes come back as they went in.
inline std::uint64_t pack_octahedral(Vec3d n, int bits) {
  const double scale = double((std::uint64_t(1) << (bits - 1)) - 1);
  const Octahedral o = to_octahedral(n);
  return std::uint64_t((o.u + 1) * scale + 0.5) << bits | std::uint64_t((o.v + 1) * scale + 0.5);
}

inline Vec3d unpack_octahedral(std::uint64_t key, int bits) {
  const double scale = double((std::uint64_t(1) << (bits - 1)) - 1);
  const std::uint64_t mask = (std::uint64_t(1) << bits) - 1;
  return from_octahedral({double(key >> bits) / scale - 1, double(key & mask) / scale - 1});
}

}  // namespace burnish
