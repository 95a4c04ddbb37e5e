#include "burnish/palette/palette_order.h"

#include <utility>

#include "burnish/palette/octahedral.h"

namespace burnish {

std::uint64_t curve_position(Vec3f normal) {
  constexpr int kBits = 16;
  const std::uint64_t packed = pack_octahedral(Vec3d(normal), kBits);
  std::uint32_t x = std::uint32_t(packed >> kBits), y = std::uint32_t(packed & 0xffff);
  std::uint64_t d = 0;
  for (std::uint32_t s = 1u << (kBits - 1); s > 0; s /= 2) {
    const std::uint32_t rx = (x & s) != 0, ry = (y & s) != 0;
    d += std::uint64_t(s) * s * ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx) x = (1u << kBits) - 1 - x, y = (1u << kBits) - 1 - y;
      std::swap(x, y);
    }
  }
  return d;
}

}  // namespace burnish
