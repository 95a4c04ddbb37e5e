// A normal and its texels: what the engines that work on the sphere are given.
#pragma once

#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

struct WeightedNormal {
  Vec3f normal;  // unit
  float weight;  // > 0
};

// Of at least one; where they cancel out, the first.
inline Vec3f mean_normal(const std::vector<WeightedNormal>& points) {
  Vec3d sum;
  for (const WeightedNormal& p : points) sum += Vec3d(p.normal) * double(p.weight);
  return length(sum) > 1e-9 ? Vec3f(normalized(sum)) : points[0].normal;
}

}  // namespace burnish
