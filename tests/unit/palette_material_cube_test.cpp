#include <gtest/gtest.h>

#include <set>

#include "burnish/palette/material_cube.h"
#include "expect_error.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::angle_deg;
using testing::Random;

// A component in 8 bits, by the rule for unit vectors in integer files, unrounded.
double in_bytes(float v) { return (0.5 * v + 0.5) * 255; }

TEST(PaletteMaterialCube, AlphaKeepsTheNormalsBytesAndSpreadsTheMaterials) {
  Random random(1);
  for (int m = 1; m <= 256; m++) {
    const MaterialCube cube(MaterialEncoding::kAlpha, m);
    EXPECT_EQ(cube.channels(), 4);
    float last = 256;
    for (int k = 0; k < m; k++) {
      const Vec3f n = random.direction();
      const Colour c = cube.encode(k, n);
      EXPECT_NEAR(c[0], in_bytes(n.x), 0.5001);
      EXPECT_NEAR(c[1], in_bytes(n.y), 0.5001);
      EXPECT_NEAR(c[2], in_bytes(n.z), 0.5001);
      for (const float component : c) EXPECT_EQ(component, std::floor(component));
      if (k == 0) {
        EXPECT_EQ(c[3], 255);
      }
      EXPECT_LT(c[3], last);
      if (m < 256) {
        EXPECT_GT(c[3], 0) << "material " << k << " of " << m << " would vanish where colours are multiplied by alpha";
      }
      if (m <= 4) {
        EXPECT_GE(last - c[3], k ? 53 : 1);
      }
      last = c[3];
      EXPECT_EQ(cube.decode(c).material, k) << "of " << m;
      EXPECT_LT(angle_deg(cube.decode(c).normal, n), 0.4);  // half a step of 1/127.5 in each component
    }
  }
}

TEST(PaletteMaterialCube, SubcubesAreTheHalvedColourInACornerOfTheirOwn) {
  const int bits[4][3] = {{0, 0, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
  Random random(2);
  for (int m = 1; m <= 4; m++) {
    const MaterialCube cube(MaterialEncoding::kSubcubes, m);
    EXPECT_EQ(cube.channels(), 3);
    for (int k = 0; k < m; k++)
      for (int i = 0; i < 2000; i++) {
        const Vec3f n = random.direction();
        const Colour c = cube.encode(k, n), whole = MaterialCube(MaterialEncoding::kAlpha, 1).encode(0, n);
        for (int a = 0; a < 3; a++) ASSERT_EQ(c[a], int(whole[a]) / 2 + 128 * bits[k][a]) << "component " << a;
        ASSERT_EQ(cube.decode(c).material, k);
        ASSERT_LT(angle_deg(cube.decode(c).normal, n), 0.8);
      }
  }
  for (int a = 0; a < 4; a++)
    for (int b = 0; b < a; b++) {
      int differ = 0;
      for (int i = 0; i < 3; i++) differ += bits[a][i] != bits[b][i];
      EXPECT_GE(differ, 2) << "cubes that share a face";
    }
  EXPECT_ERROR(MaterialCube(MaterialEncoding::kSubcubes, 5), ErrorKind::kUnsupported, "at most 4 materials, not 5");
}

TEST(PaletteMaterialCube, EveryColourOfASubcubeIsItsMaterials) {
  const MaterialCube cube(MaterialEncoding::kSubcubes, 4);
  const int bits[4][3] = {{0, 0, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
  for (int k = 0; k < 4; k++)
    for (int r = 0; r < 128; r += 127)
      for (int g = 0; g < 128; g += 9)
        for (int b = 0; b < 128; b += 9)
          ASSERT_EQ(
              cube.decode({float(r + 128 * bits[k][0]), float(g + 128 * bits[k][1]), float(b + 128 * bits[k][2]), 255})
                  .material,
              k)
              << r << " " << g << " " << b;
}

TEST(PaletteMaterialCube, WhatQuantizersMixedGoesToTheNearestMaterial) {
  const MaterialCube alpha(MaterialEncoding::kAlpha, 2);  // alphas 255 and 96
  EXPECT_EQ(alpha.decode({255, 128, 128, 0}).material, 1);
  EXPECT_EQ(alpha.decode({255, 128, 128, 175}).material, 1);
  EXPECT_EQ(alpha.decode({255, 128, 128, 175.5}).material, 0);  // halfway
  EXPECT_EQ(alpha.decode({255, 128, 128, 176}).material, 0);
  EXPECT_LT(angle_deg(alpha.decode({255, 127.5, 127.5, 0}).normal, {1, 0, 0}), 1e-4);
  EXPECT_EQ(alpha.decode({127.5, 127.5, 127.5, 255}).normal, (Vec3f{0, 0, 1}));  // no direction

  // In the corner of no material: one step into 011.
  const MaterialCube cubes(MaterialEncoding::kSubcubes, 4);
  EXPECT_EQ(cubes.decode({128, 200, 200, 255}).material, 1);
  EXPECT_EQ(cubes.decode({200, 128, 200, 255}).material, 2);
  EXPECT_EQ(cubes.decode({200, 200, 128, 255}).material, 3);
  // Where the fourth material does not occur, its corner is another's.
  const MaterialCube three(MaterialEncoding::kSubcubes, 3);
  EXPECT_NE(three.decode({200, 200, 20, 255}).material, 3);
}

}  // namespace
}  // namespace burnish
