#include "burnish/material/direction_pairs.h"

#include <cmath>

#include "burnish/core/vec3.h"

namespace burnish {
namespace {

constexpr double kLeastLightCosine = 0.3, kLeastViewCosine = 0.695;

// Of unit coordinates; uniform over the cap.
Vec3d in_cap(double least_cosine, double height, double turn) {
  const double z = 1 - height * (1 - least_cosine), r = std::sqrt(1 - z * z), angle_rad = 2 * kPi * turn;
  return {r * std::cos(angle_rad), r * std::sin(angle_rad), z};
}

void put(Vec3d v, float (&to)[3][PairBlock::kPairs], int i) {
  to[0][i] = float(v.x), to[1][i] = float(v.y), to[2][i] = float(v.z);
}

}  // namespace

std::vector<PairBlock> direction_pairs(std::size_t blocks) {
  constexpr double kRatio = 1.1673039782614187;  // x⁵ = x + 1: the golden ratio of four dimensions
  std::vector<PairBlock> out(blocks);
  std::size_t index = 0;
  for (PairBlock& block : out)
    for (int i = 0; i < PairBlock::kPairs; i++) {
      index++;
      double u[4], step = 1;
      for (double& coordinate : u) {
        step /= kRatio;
        coordinate = 0.5 + step * double(index);
        coordinate -= std::floor(coordinate);
      }
      const Vec3d l = in_cap(kLeastLightCosine, u[0], u[1]), v = in_cap(kLeastViewCosine, u[2], u[3]);
      put(l, block.l, i), put(v, block.v, i), put(normalized(l + v), block.h, i);
    }
  return out;
}

}  // namespace burnish
