#include <gtest/gtest.h>

#include "burnish/brdf/banks.h"
#include "burnish/render/anisotropy/register_combiners.h"
#include "burnish/render/metrics.h"
#include "expect_error.h"
#include "reflectance_fixture.h"

namespace burnish {
namespace {

using namespace testing;

const struct {
  ReflectanceModel model;
  RenderPath path;
} kTablePaths[] = {{ReflectanceModel::kBanks, RenderPath::kBanks},
                   {ReflectanceModel::kBanksApproximate, RenderPath::kBanksApproximate},
                   {ReflectanceModel::kBlinnPhong, RenderPath::kBlinnPhong},
                   {ReflectanceModel::kBlinnPhongEquation1, RenderPath::kBlinnPhongEquation1},
                   {ReflectanceModel::kWard, RenderPath::kWard}};

TEST(ReflectancePaths, TablesKeepToTheFormulas) {
  for (const bool sphere : {false, true})
    for (const auto& [model, path] : kTablePaths) {
      const ReflectiveScene s = reflective(model, bumpy_maps(64, 0.3, 0.3, 0.8), sphere);
      EXPECT_GE(psnr_db(s, path), 65) << name(path) << (sphere ? " on a sphere" : "");
    }
}

TEST(ReflectancePaths, WithoutTablesTheyAreExact) {
  for (const RenderPath path : {RenderPath::kBanksApproximate, RenderPath::kBlinnPhongEquation1}) {
    const ReflectanceModel model = path == RenderPath::kBanksApproximate ? ReflectanceModel::kBanksApproximate
                                                                         : ReflectanceModel::kBlinnPhongEquation1;
    EXPECT_GE(psnr_db(reflective(model, bumpy_maps(64, 0.3, 0.3, 0.8), true), path), 110) << name(path);
  }
}

// The one pixel's colour is diffuse · n·l + specular · L_o of the formula, by hand.
TEST(ReflectancePaths, TheTwinIsTheFormula) {
  const ReflectiveScene s = reflective(ReflectanceModel::kBanks, one_texel({0.8f, 0.6f, 0}));
  const Vec3d l = s.scene.lights[0].direction, v{0, 0, 1};
  const double expected = 0.2 * l.z + 0.6 * banks({{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}}, 0.7, l, v);
  const Frame frame = render(s.scene, s.assets, RenderPath::kAnalytic);
  EXPECT_NEAR(frame.colour.at(30, 30)[1], expected, 1e-6);
}

TEST(RegisterCombiners, HoldASignAndEightBits) {
  using namespace combiners;
  for (int i = 0; i <= 255; i++) EXPECT_NEAR(held(expand_normal(i / 255.f)), (2 * i - 255) / 255.0, 1e-7) << i;
  EXPECT_EQ(held(0.0019f), 0);
  EXPECT_FLOAT_EQ(held(-0.0021f), -1 / 255.f);
  EXPECT_EQ(dot_stage({0.5f, 0.5f, 0}, {1, 1, 0}, 4), 1);
  EXPECT_EQ(dot_stage({0.5f, 0.5f, 0}, {-1, -1, 0}, 4), -1);
  EXPECT_FLOAT_EQ(dot_stage({0.2f, 0, 0}, {0.5f, 0, 0}, 4), 102 / 255.f);
  EXPECT_FLOAT_EQ(sum_stage(0.6f, 0.6f, 0.6f, 0.6f, 1), 184 / 255.f);
  EXPECT_EQ(final_one_minus(1.5f, 1), 0);
  EXPECT_EQ(final_one_minus(-0.5f, 1), 1);
  EXPECT_FLOAT_EQ(final_one_minus(0, 0.5f), 128 / 255.f);
}

// Turning object, camera and light together changes nothing.
TEST(ReflectancePaths, TheFrameTurnsWithTheObject) {
  ReflectiveScene s = reflective(ReflectanceModel::kWard, bumpy_maps(32, 0.3, 0.2, 0.6));
  const Frame straight = render(s.scene, s.assets, RenderPath::kAnalytic);
  const Rotation turn = rotation_xyz({0.4, 1.1, -0.3});
  s.scene.objects[0].transform.rotation = turn;
  s.scene.camera.position = turn.apply(s.scene.camera.position), s.scene.camera.up = turn.apply(s.scene.camera.up);
  s.scene.lights[0].direction = turn.apply(s.scene.lights[0].direction);
  for (const RenderPath path : {RenderPath::kAnalytic, RenderPath::kWard}) {
    const Frame turned = render(s.scene, s.assets, path);
    EXPECT_GE(compare(turned.colour, straight.colour, straight.covered).psnr_db, 45) << name(path);
  }
}

// A lobe between texels: interpolating their frames first sharpens or blurs it, shading first does not.
TEST(ReflectancePaths, FilteringAfterShadingIsTheTwinsAndBeforeItIsNot) {
  ReflectiveScene s = reflective(ReflectanceModel::kBlinnPhongEquation1, bumpy_maps(12, 0.5, 0.3, 0.3));
  s.scene.objects[0].filter = Filter::kBilinear;
  s.scene.objects[0].reflectance->order = FilterOrder::kAfterShading;
  EXPECT_GE(psnr_db(s, RenderPath::kBlinnPhongEquation1), 110);
  s.scene.objects[0].reflectance->order = FilterOrder::kBeforeShading;
  EXPECT_LE(psnr_db(s, RenderPath::kBlinnPhongEquation1), 30);
}

TEST(ReflectancePaths, CombinersKeepToEightBits) {
  ReflectiveScene s = reflective(ReflectanceModel::kBlinnPhongEquation1, bumpy_maps(64, 0.3, 0.5, 0.8), false, true);
  const double at_texels = psnr_db(s, RenderPath::kCombiner);
  EXPECT_GE(at_texels, 38);
  EXPECT_LE(at_texels, 60);
  s = reflective(ReflectanceModel::kBlinnPhongEquation1, bumpy_maps(12, 0.5, 0.3, 0.3), false, true);
  s.scene.objects[0].filter = Filter::kBilinear;
  const double before = psnr_db(s, RenderPath::kCombiner);
  s.scene.objects[0].reflectance->order = FilterOrder::kAfterShading;
  EXPECT_GE(psnr_db(s, RenderPath::kCombiner), before + 6);
}

TEST(ReflectancePaths, TheImagingSubsetKeepsToEightBits) {
  const ReflectiveScene s =
      reflective(ReflectanceModel::kBlinnPhongEquation1, bumpy_maps(64, 0.3, 0.5, 0.8), false, true);
  EXPECT_GE(psnr_db(s, RenderPath::kImaging), 38);
}

TEST(ReflectancePaths, TheImagingSubsetRefusesWhatChangesTheHalfwayVector) {
  const auto refused = [](ReflectiveScene s, const std::string& why) {
    EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kImaging), ErrorKind::kMalformed,
                 "scene.toml': path 'imaging' needs " + why);
  };
  const ReflectanceMaps maps = bumpy_maps(4, 0.3, 0.5, 0.8);
  const auto model = ReflectanceModel::kBlinnPhongEquation1;
  refused(reflective(model, maps, true, true), "flat surfaces, got a sphere");
  ReflectiveScene point = reflective(model, maps, false, true);
  point.scene.lights[0].type = LightType::kPoint;
  refused(point, "directional lights, got a point light");
  ReflectiveScene perspective = reflective(model, maps, false, true);
  perspective.scene.camera.type = CameraType::kPerspective;
  refused(perspective, "an orthographic viewer");
}

TEST(ReflectancePaths, StrandsKeepToTheFormula) {
  for (const bool sphere : {false, true}) {
    ReflectanceMaps maps = bumpy_maps(64, 0.3, 1, 1);
    ReflectiveScene bumpy = reflective(ReflectanceModel::kStrand, maps, sphere);
    maps.bumpy = false, maps.material.t = maps.directions;
    maps.material.n.assign(maps.directions.size(), {0, 0, 1});
    ReflectiveScene flat = reflective(ReflectanceModel::kStrand, maps, sphere);
    EXPECT_GE(psnr_db(flat, RenderPath::kStrandPs11), 45);
    flat.scene.lights.push_back({LightType::kDirectional, normalized(Vec3d{1, 0, 1}), {}, {0.2, 0.1, 0.7}});
    EXPECT_GE(psnr_db(flat, RenderPath::kStrandPs14), 45);
    bumpy.scene.tables = default_tables(TableLayout::kCubeZ);
    const double normalised = psnr_db(bumpy, RenderPath::kStrandBump);
    EXPECT_GE(normalised, 45);
    EXPECT_LT(psnr_db(bumpy, RenderPath::kStrandBumpUnnormalised), normalised);
  }
}

TEST(ReflectancePaths, StrandShadersRefuseWhatTheyDoNotHave) {
  ReflectiveScene s = reflective(ReflectanceModel::kStrand, one_texel());
  const auto refused = [&](RenderPath path, const std::string& why) {
    EXPECT_ERROR(render(s.scene, s.assets, path), ErrorKind::kMalformed, why);
  };
  refused(RenderPath::kStrandBump, "strand.exr': expected a table of layout cube-z, as path 'strand-bump' looks it up");
  s.scene.lights.resize(2);
  refused(RenderPath::kStrandPs11, "path 'strand-ps11' takes one light, got 2");
  s.scene.lights.resize(5);
  refused(RenderPath::kStrandPs14, "path 'strand-ps14' takes up to four lights, got 5");
  s.scene.lights.resize(1);
  s.assets.reflectance->bumpy = true;
  refused(RenderPath::kStrandPs11, "takes no normal map");
  s.assets.reflectance->bumpy = false;
  s.scene.objects[0].reflectance->gloss = true;
  refused(RenderPath::kStrandPs14, "has no gloss");
  s.scene.tables.clear();
  refused(RenderPath::kStrandPs11, "needs the table of strand, [tables] strand");
}

TEST(ReflectancePaths, ModelsTexturesAndTablesMustBeThere) {
  ReflectiveScene s = reflective(ReflectanceModel::kWard, bumpy_maps(4, 0.3, 0.5, 0.8));
  const auto refused = [&](RenderPath path, const std::string& why) {
    EXPECT_ERROR(render(s.scene, s.assets, path), ErrorKind::kMalformed, why);
  };
  refused(RenderPath::kBanks, "path 'banks' needs the model banks, which the quad has not");
  refused(RenderPath::kStrandPs11, "path 'strand-ps11' needs the model strand");
  refused(RenderPath::kCombiner, "path 'combiner' needs the model blinn-phong");
  s.scene.tables.erase(LookupKind::kWardE);
  refused(RenderPath::kWard, "path 'ward' needs the table of ward-e, [tables] ward_e");
  s.assets.textures.reset();
  refused(RenderPath::kWard, "path 'ward' needs material textures");
  s.scene.objects[0].reflectance.reset();
  refused(RenderPath::kWard, "path 'ward' needs an [object.reflectance], and the quad has none");
  s = reflective(ReflectanceModel::kBlinnPhong, bumpy_maps(4, 0.3, 0.5, 0.8));
  refused(RenderPath::kCombiner, "path 'combiner' needs textures in the combiners' range");
}

}  // namespace
}  // namespace burnish
