// Thin scratches along u and along v on a surface that is otherwise glossy the same in all directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/core/vec3.h"
#include "noise.h"

namespace burnish {

// What a texel reflects by (Kautz & Seidel, section 4: the tangent runs along a scratch, and α_x is small beside α_y).
struct Scratched {
  Vec3d direction{1, 0, 0};
  double alpha_x = 0.3, alpha_y = 0.3, k_s = 0.2;
};

// A tile of side × side texels.
inline std::vector<Scratched> scratched_tile(int side, int scratches) {
  std::vector<Scratched> tile(std::size_t(side) * side);
  std::vector<double> deepest(tile.size());
  const auto wrap = [side](int i) { return ((i % side) + side) % side; };
  for (int s = 0; s < scratches; s++) {
    const auto random = [s](int what) { return hash(s, what, 0, 60); };
    const bool along_u = s % 2 == 0;
    const double length = side * (0.06 + 0.5 * std::pow(random(1), 3)), slant = 0.05 * (random(2) - 0.5);
    const double half_width = 0.9 + 0.9 * std::pow(random(3), 2), depth = 0.45 + 0.55 * random(4);
    const int first = int(side * random(5));
    const double across = side * random(6);
    for (int i = 0; i < int(length); i++) {
      const double middle = across + slant * i, tip = std::min(1.0, 4 * std::min(i + 1.0, length - i) / length);
      for (int j = int(std::floor(middle - 2)); j <= int(std::ceil(middle + 2)); j++) {
        const double cover = depth * tip * std::clamp(half_width + 0.5 - std::abs(j + 0.5 - middle), 0.0, 1.0);
        const int x = wrap(along_u ? first + i : j), y = wrap(along_u ? j : first + i);
        const std::size_t texel = std::size_t(y) * side + x;
        if (cover <= deepest[texel]) continue;
        deepest[texel] = cover;
        // Rows run downwards and v runs up.
        const Vec3d direction = along_u ? Vec3d{1, -slant, 0} : Vec3d{-slant, 1, 0};
        const auto blend = [cover](double ground, double scratch) { return ground + cover * (scratch - ground); };
        tile[texel] = {normalized(direction), blend(0.3, 0.25), blend(0.3, 1), blend(0.2, 1)};
      }
    }
  }
  return tile;
}

}  // namespace burnish
