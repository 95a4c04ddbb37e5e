// The colour table against its twin.
#include <gtest/gtest.h>

#include "burnish/render/metrics.h"
#include "burnish/render/palette/palette_table.h"
#include "burnish/render/palette/table_kernels.h"
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
  s.materials[0] = testing::glossy({1, 1, 1}, {0.6, 0.5, 0.4}, {0.5, 0.6, 0.7}, 60);
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
  s.materials.push_back({1, {Lambert{{1, 0, 0}, {0, 1, 0}}}});
  s.materials.push_back(testing::glossy({}, {0.1, 0.2, 0.3}, {1, 1, 1}, 5));
  s.materials[2].id = 2;
  EXPECT_LE(largest_difference(s, indexed_assets(s, 64, 1000, true, 3)), 1e-6);
}

TEST(RenderPalettePath, EveryObjectHasItsOwnTable) {
  Scene s = sphere_scene(97);
  light_and_turn(s);
  s.objects.push_back(s.objects[0]);
  s.objects[0].transform.translation = {-0.3, 0, 0};
  s.objects[1].transform.translation = {0.3, 0, 0};
  s.objects[0].surface.radius = s.objects[1].surface.radius = 0.25;
  s.objects[1].transform.rotation = rotation_xyz({radians(-70), radians(10), radians(5)});
  const std::vector<ObjectAssets> assets{indexed_assets(s, 64, 2048, false), indexed_assets(s, 32, 300, false)};
  const auto picture = [&](RenderPath path) { return render_frame(s, assets, {path, 1, 0, {}}); };
  const Frame palette = picture(RenderPath::kPalette), analytic = picture(RenderPath::kAnalytic);
  const ErrorMetrics m = compare(palette.colour, analytic.colour, palette.covered);
  EXPECT_GT(m.pixels, 1000u);
  EXPECT_LE(m.max_abs, 1e-6);
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

// Every lighting model, as one term.
std::vector<std::pair<std::string, LightingModel>> all_models() {
  const auto term = [](const Material& m) { return m.terms[0]; };
  Cartoon cartoon;
  cartoon.bands = 4, cartoon.outline_cosine = 0.25;
  Image sky(16, 8, 3);
  for (std::size_t i = 0; i < sky.data.size(); i++) sky.data[i] = float((i * 37) % 11) / 5;
  Environment environment;
  environment.panorama = std::make_shared<const Panorama>(sky);
  environment.turn_rad = 0.7;
  return {{"lambert", Lambert{{1, 1, 1}, {0.6, 0.5, 0.4}}},
          {"phong", term(testing::glossy({1, 1, 1}, {0.6, 0.5, 0.4}, {0.5, 0.6, 0.7}, 60))},
          {"a sharp phong", term(testing::glossy({1, 1, 1}, {0.6, 0.5, 0.4}, {0.5, 0.6, 0.7}, 900))},
          {"a phong beyond the vectorised power", term(testing::glossy({}, {}, {1, 1, 1}, 5000))},
          {"a phong of exponent 0", term(testing::glossy({}, {}, {1, 1, 1}, 0))},
          {"npr-double", term(testing::glossy<NprDouble>({1, 1, 1}, {0.6, 0.5, 0.4}, {0.5, 0.6, 0.7}, 12))},
          {"cartoon", cartoon},
          {"chrome", Chrome{}},
          {"environment", environment}};
}

TEST(RenderPalettePath, EveryModelAndBlendEqualsItsTwinOnAStretchedTurnedObject) {
  for (const auto& [model_name, model] : all_models())
    for (Blend blend : {Blend::kMaterial, Blend::kExact, Blend::kApproximate}) {
      Scene s = sphere_scene(61);
      light_and_turn(s);
      s.objects[0].transform.scale = {1, 0.6, 0.8};
      s.objects[0].base.blend = blend;
      s.objects[0].base.colour = {0.7, 0.4, 0.9};
      s.materials[0] = {{}, {model}};
      ObjectAssets a = indexed_assets(s, 64, 2048, false);
      if (blend != Blend::kMaterial) {
        a.base_map.emplace(5, 3, 3);
        for (std::size_t i = 0; i < a.base_map->data.size(); i++) a.base_map->data[i] = float(i % 7) / 7;
      }
      EXPECT_LE(largest_difference(s, a), 1e-6) << model_name << ", blend " << int(blend);
      const Frame looked_up = render(s, a, RenderPath::kPalette), expanded = render(s, a, RenderPath::kPaletteExpanded);
      EXPECT_EQ(looked_up.colour.data, expanded.colour.data) << model_name;
    }
}

LightingModel dimmed(LightingModel model, double factor) {
  const auto dim = [&](auto& m) {
    if constexpr (requires { m.ambient; }) m.ambient = m.ambient * factor;
    if constexpr (requires { m.diffuse; }) m.diffuse = m.diffuse * factor;
    if constexpr (requires { m.specular; }) m.specular = m.specular * factor;
    if constexpr (requires { m.shadow; }) m.shadow = m.shadow * factor, m.outline = m.outline * factor;
  };
  std::visit(dim, model);
  return model;
}

TEST(RenderPalettePath, ASumOfModelsEqualsItsTwin) {
  Scene s = sphere_scene(61);
  light_and_turn(s);
  s.materials[0].terms.clear();
  for (const auto& [model_name, model] : all_models()) s.materials[0].terms.push_back(dimmed(model, 1 / 6.0));
  for (Blend blend : {Blend::kMaterial, Blend::kExact}) {
    s.objects[0].base.blend = blend;
    EXPECT_LE(largest_difference(s, indexed_assets(s, 64, 2048, false)), 1e-6);
  }
}

// A table of one material over normals all around, before white light from (1, 2, 2)/3 and a viewer along +z.
PaletteTable shaded_table(const Palette& palette, const std::vector<const Material*>& materials, Blend blend) {
  const std::vector<Arriving> lights{{normalized(Vec3d{1, 2, 2}), {1, 1, 1}}};
  PaletteTable table(palette, materials, {}, blend);
  table.shade({lights, {0.1, 0.1, 0.1}, {0, 0, 1}});
  return table;
}

TEST(RenderPaletteTable, EveryIntervalHasItsOwnModel) {
  Palette p;
  p.normals = testing::spread_normals(3000, true);
  p.materials = {{3, 0, 1500}, {9, 1500, 1500}};
  const Material lambert{3, {Lambert{{}, {1, 1, 1}}}}, phong = testing::glossy({}, {}, {1, 1, 1}, 7);
  const PaletteTable c = shaded_table(p, {&lambert, &phong}, Blend::kMaterial);
  ASSERT_EQ(c.channels(), 3);
  const Vec3d l = normalized(Vec3d{1, 2, 2}), v{0, 0, 1};
  for (int i = 0; i < 3000; i++) {
    const Vec3d n = normalized(Vec3d(p.normals[i]));
    const double nl = std::max(0.0, dot(n, l)), rv = std::max(0.0, dot(n * (2 * nl) - l, v));
    if (i < 1500) ASSERT_EQ(c.plane(0)[i], float(nl)) << "entry " << i;
    else ASSERT_NEAR(c.plane(0)[i], nl > 0 ? std::pow(rv, 7) : 0, 1.5e-7) << "entry " << i;
  }
}

TEST(RenderPaletteTable, HoldsWhatItsBlendingNeeds) {
  Palette p;
  p.normals = testing::spread_normals(600, true);
  p.materials = {{0, 0, 600}};
  const Material lambert{{}, {Lambert{{1, 1, 1}, {0.5, 0.5, 0.5}}}},
      phong = testing::glossy({1, 1, 1}, {0.5, 0.5, 0.5}, {0.2, 0.4, 0.6}, 9);
  const PaletteTable intensity = shaded_table(p, {&lambert}, Blend::kExact),
                     both = shaded_table(p, {&phong}, Blend::kApproximate),
                     rgb = shaded_table(p, {&phong}, Blend::kMaterial);
  ASSERT_EQ(intensity.channels(), 1);
  ASSERT_EQ(both.channels(), 4);
  for (int i = 0; i < 600; i++) {
    const double alpha = 0.1 + 0.5 * std::max(0.0, dot(normalized(Vec3d(p.normals[i])), normalized(Vec3d{1, 2, 2})));
    ASSERT_NEAR(intensity.plane(0)[i], alpha, 1e-6);
    ASSERT_NEAR(both.plane(3)[i], alpha, 1e-6);
    for (int c = 0; c < 3; c++) ASSERT_NEAR(both.plane(c)[i] + alpha, rgb.plane(c)[i], 1e-6);
    ASSERT_NEAR(both.plane(2)[i], 3 * both.plane(0)[i], 1e-6);
  }
}

TEST(RenderPaletteTable, ThePowerIsExactToOneAndAHalfPartsInTenMillion) {
  constexpr int kCount = 200000;
  std::vector<double> bases{0, 1e-12, 1e-6, 0.5, 1 - 1e-12, 1};
  for (int i = 0; i < kCount; i++) bases.push_back((i + 0.5) / kCount);
  for (int i = 0; i < kCount; i++) bases.push_back(1 - std::pow(10, -10 * (i + 0.5) / kCount));
  std::vector<float> base, complement, out(bases.size()), none(bases.size()), unused(bases.size());
  for (double b : bases) base.push_back(float(b)), complement.push_back(float(1 - b));
  for (double e : {0.01, 0.5, 1.0, 1.5, 2.0, 3.7, 20.0, 100.0, 1000.0}) {
    kernels::add_highlight(none.data(), base.data(), complement.data(), {}, {1, 0, 0}, float(e), Vec3f{}, base.size(),
                           {out.data(), unused.data(), unused.data()});
    for (std::size_t i = 0; i < bases.size(); i++)
      ASSERT_NEAR(out[i], std::pow(bases[i], double(float(e))), 1.5e-7) << bases[i] << '^' << e;
  }
}

TEST(RenderPaletteTable, WhatIsAddedIsTheSameWithAndWithoutAStart) {
  const std::vector<float> share{0.1f, 0.5f, 1};
  std::vector<float> started(3), added(3, 0.25f);
  kernels::add(share.data(), 0.5f, 0.25f, 3, started.data());
  kernels::add(share.data(), 0.5f, {}, 3, added.data());
  EXPECT_EQ(started, added);
  EXPECT_EQ(started[2], 0.75f);
}

}  // namespace
}  // namespace burnish
