// The colour table against its twin.
#include <gtest/gtest.h>

#include "burnish/render/metrics.h"
#include "burnish/render/palette_table.h"
#include "expect_error.h"
#include "render_fixture.h"

namespace burnish {
namespace {

using testing::indexed_assets;
using testing::quad_scene;
using testing::render;
using testing::sphere_scene;

double largest_difference(const Scene& s, const ObjectAssets& a) {
  const Frame palette = render(s, a, RenderPath::kPalette), analytic = render(s, a, RenderPath::kAnalytic);
  const ErrorMetrics m = compare(palette.colour, analytic.colour, palette.covered);
  EXPECT_GT(m.pixels, 100u);
  return m.max_abs;
}

void light_and_turn(Scene& s) {
  s.ambient = {0.03, 0.02, 0.01};
  s.lights[0].direction = normalized(Vec3d{0.5, 0.3, 0.7});
  s.lights[0].colour = {1, 0.9, 0.7};
  s.lights.push_back(s.lights[0]);
  s.lights[1].direction = normalized(Vec3d{-0.8, 0.1, 0.4});
  s.lights[1].intensity = 0.5;
  s.objects[0].transform.rotation = rotation_xyz({radians(20), radians(-35), radians(50)});
  s.objects[0].transform.translation = {0.03, -0.02, 0.2};
  s.materials[0].model = Phong{{1, 1, 1}, {0.6, 0.5, 0.4}, {0.5, 0.6, 0.7}, 60};
}

TEST(RenderPalettePath, EqualsItsTwinOnAQuad) {
  Scene s = quad_scene(97);
  light_and_turn(s);
  EXPECT_LE(largest_difference(s, indexed_assets(s, 64, 2048, true)), 1e-6);
}

TEST(RenderPalettePath, EqualsItsTwinOnASphere) {
  Scene s = sphere_scene(97);
  light_and_turn(s);
  EXPECT_LE(largest_difference(s, indexed_assets(s, 64, 2048, false)), 1e-6);
}

TEST(RenderPalettePath, EqualsItsTwinWithMaterials) {
  Scene s = quad_scene(97);
  light_and_turn(s);
  s.materials[0].id = 0;
  s.materials.push_back({1, Lambert{{1, 0, 0}, {0, 1, 0}}});
  s.materials.push_back({2, Phong{{}, {0.1, 0.2, 0.3}, {1, 1, 1}, 5}});
  EXPECT_LE(largest_difference(s, indexed_assets(s, 64, 1000, true, 3)), 1e-6);
}

TEST(RenderPalettePath, APointLightIsTakenAtTheObjectsOrigin) {
  Scene s = quad_scene(96);
  s.lights[0].type = LightType::kPoint;
  s.lights[0].position = {0, 0, 1};
  s.objects[0].transform.translation = {0.25, 0, 0};
  ObjectAssets a = indexed_assets(s, 1, 2, true);
  a.indexed->palette.normals.assign(2, Vec3f{0, 0, 1});
  a.normals[0] = {0, 0, 1};
  const double expected = 1 / std::sqrt(1 + 0.25 * 0.25);
  EXPECT_NEAR(render(s, a, RenderPath::kPalette).colour.at(60, 50)[0], expected, 1e-7);
  EXPECT_GT(largest_difference(s, a), 0.01) << "the twin shades every point by itself";
}

TEST(RenderPalettePath, ChoosesTheMipLevelThatFits) {
  Scene s = quad_scene(16);
  s.objects[0].mip = MipMode::kNearest;
  ObjectAssets a = indexed_assets(s, 64, 8, true);
  for (int side = 32, level = 1; side >= 1; side /= 2, level++) {
    a.indexed->levels.emplace_back(side, side);
    std::ranges::fill(a.indexed->levels.back().data, std::uint16_t(level));
  }
  EXPECT_EQ(render(s, a, RenderPath::kPalette, {Aov::kIndex}).aovs[0].data[7], 2) << "four texels a pixel";
  s.samples = 2;
  EXPECT_EQ(render(s, a, RenderPath::kPalette, {Aov::kLevel}).aovs[0].data[7], 1) << "two texels a sample";
  s.samples = 1;
  s.objects[0].mip = MipMode::kOff;
  EXPECT_EQ(render(s, a, RenderPath::kPalette, {Aov::kLevel}).aovs[0].data[7], 0);
}

TEST(RenderPalettePath, LinearMipsBlendTwoLevels) {
  Scene s = quad_scene(16);
  s.objects[0].mip = MipMode::kLinear;
  s.objects[0].surface.repeat_u = std::sqrt(2.0);  // λ = ½ between levels 1 and 2
  ObjectAssets a = indexed_assets(s, 32, 3, true);
  a.indexed->palette.normals = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0.8f, 0, 0.6f}};
  for (int side = 16, level = 1; side >= 1; side /= 2, level++) {
    a.indexed->levels.emplace_back(side, side);
    std::ranges::fill(a.indexed->levels.back().data, std::uint16_t(std::min(level, 2)));
  }
  EXPECT_NEAR(render(s, a, RenderPath::kPalette).colour.data[0], 0.7, 1e-6);
}

TEST(RenderPalettePath, BilinearBlendsColoursNotIndices) {
  Scene s = quad_scene(2);
  s.objects[0].surface.repeat_u = s.objects[0].surface.repeat_v = 0.5;  // pixel centres on quarters of the map
  s.objects[0].filter = Filter::kBilinear;
  ObjectAssets a = indexed_assets(s, 2, 5, true);
  a.indexed->palette.normals[0] = {0, 0, 1};
  a.indexed->palette.normals[4] = {0.6f, 0, 0.8f};
  a.indexed->levels[0].data = {0, 4, 0, 4};
  const Frame f = render(s, a, RenderPath::kPalette);
  // u = 1/8 and 3/8: a quarter texel left of the first centre, and right of it.
  EXPECT_NEAR(f.colour.at(0, 0)[0], 0.75 * 1 + 0.25 * 0.8, 1e-6);
  EXPECT_NEAR(f.colour.at(1, 0)[0], 0.75 * 1 + 0.25 * 0.8, 1e-6);
}

TEST(RenderPalettePath, ATangentPaletteOnASphereIsRefused) {
  Scene s = sphere_scene();
  s.objects[0].indexed_map = "rocks.exr";
  ObjectAssets a = indexed_assets(s, 4, 8, false);
  a.space = NormalSpace::kTangent;
  EXPECT_ERROR(render(s, a, RenderPath::kPalette), ErrorKind::kMalformed,
               "'rocks.exr': a tangent-space palette can be shaded on a flat surface only");
  EXPECT_NO_THROW(render(s, a, RenderPath::kAnalytic));
}

TEST(RenderPalettePath, NeedsAnIndexedMapAndAChainForMips) {
  Scene s = quad_scene();
  EXPECT_ERROR(render(s, testing::constant_normals(s, {0, 0, 1}), RenderPath::kPalette), ErrorKind::kMalformed,
               "needs an 'indexed_map'");
  s.objects[0].mip = MipMode::kNearest;
  EXPECT_ERROR(render(s, indexed_assets(s, 4, 8, true), RenderPath::kPalette), ErrorKind::kMalformed,
               "expected a chain of mip levels");
}

TEST(RenderPaletteTable, EveryIntervalHasItsOwnModel) {
  Palette p;
  p.normals = testing::spread_normals(3000, true);
  p.materials = {{3, 0, 1500}, {9, 1500, 1500}};
  const Material lambert{3, Lambert{{}, {1, 1, 1}}}, phong{9, Phong{{}, {}, {1, 1, 1}, 7}};
  const std::vector<const Material*> materials{&lambert, &phong};
  const Vec3d l = normalized(Vec3d{1, 2, 2}), v{0, 0, 1};
  const std::vector<Arriving> lights{{l, {1, 1, 1}}};
  const std::vector<Vec3d> c = shade_palette(p, materials, {}, lights, v);
  ASSERT_EQ(c.size(), 3000u);
  for (int i = 0; i < 3000; i++) {
    const Vec3d n(p.normals[i]);
    const double nl = std::max(0.0, dot(n, l)), rv = std::max(0.0, dot(n * (2 * nl) - l, v));
    ASSERT_NEAR(c[i].x, i < 1500 ? nl : nl > 0 ? std::pow(rv, 7) : 0, 1e-12) << "entry " << i;
  }
}

}  // namespace
}  // namespace burnish
