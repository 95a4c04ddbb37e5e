// Normal maps for tests of their mips, and all rows of these.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "burnish/normal/normal_mips.h"

namespace burnish::testing {

inline Image random_normals(int width, int height, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<float> slope(0, 0.3f);
  Image normals(width, height, 3);
  for (std::size_t i = 0; i < normals.texels(); i++) {
    const Vec3f n = normalized(Vec3f{slope(random), slope(random), 1});
    std::copy_n(&n.x, 3, &normals.data[3 * i]);
  }
  return normals;
}

// All rows of all levels.
struct Levels {
  std::vector<Image> means, alphas;
};

inline Levels made(NormalMips& mips) {
  Levels all;
  const auto add = [](std::vector<Image>& to, int level, int first, const Image& rows) {
    if (level >= int(to.size())) to.resize(level + 1);
    Image& of = to[level];
    EXPECT_EQ(of.height, first) << "level " << level;
    of.width = rows.width, of.channels = rows.channels, of.height += rows.height;
    of.data.insert(of.data.end(), rows.data.begin(), rows.data.end());
  };
  mips.make([&](const NormalMips::Rows& rows) {
    add(all.means, rows.level, rows.first, rows.means);
    if (!rows.alphas.data.empty()) add(all.alphas, rows.level, rows.first, rows.alphas);
  });
  return all;
}

}  // namespace burnish::testing
