#include "burnish/material/mips/direction_pairs.h"

#include <cmath>

#include "burnish/core/portable_math.h"
#include "burnish/core/vec3.h"

namespace burnish {
namespace {

constexpr double kLeastLightCosine = 0.3, kMostViewAngle_rad = 0.8;

Vec3d direction(double cosine, double sine, double turn) {
  return {sine * portable::cos(2 * kPi * turn), sine * portable::sin(2 * kPi * turn), cosine};
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
      const double light_cosine = 1 - u[0] * (1 - kLeastLightCosine), view_rad = kMostViewAngle_rad * u[2] * u[2];
      const Vec3d l = direction(light_cosine, std::sqrt(1 - light_cosine * light_cosine), u[1]);
      const Vec3d v = direction(portable::cos(view_rad), portable::sin(view_rad), u[3]);
      put(l, block.l, i), put(v, block.v, i), put(normalized(l + v), block.h, i);
    }
  return out;
}

}  // namespace burnish
