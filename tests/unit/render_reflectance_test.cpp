#include <gtest/gtest.h>

#include "burnish/brdf/banks.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/render/anisotropy/register_combiners.h"
#include "burnish/render/metrics.h"
#include "expect_error.h"
#include "reflectance_fixture.h"
#include "scratch_dir.h"

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

// Ward's formula by hand, over a tilted normal and with the tangent out of the plane.
TEST(ReflectancePaths, TheTwinOfABumpIsTheFormula) {
  ReflectanceMaps maps = one_texel();
  const Vec3d n{0.6, 0, 0.8}, t{0.8 * 0.6, 0.8, -0.6 * 0.6}, b = cross(n, t);  // t leans 53° from its steepest way
  maps.bumpy = true, maps.material.n = {Vec3f(n)}, maps.material.t = {Vec3f(t)};
  maps.material.alpha_x.number = 0.2f, maps.material.alpha_y.number = 0.5f;
  ReflectiveScene s = reflective(ReflectanceModel::kWard, maps);
  const Vec3d l = normalized(Vec3d{0.9, 0.2, 1}), v{0, 0, 1}, h = normalized(l + v);
  s.scene.lights[0].direction = l;
  const double x = dot(h, t) / double(0.2f), y = dot(h, b) / double(0.5f), lit = dot(n, l);
  const double f = double(0.7f) / std::sqrt(lit * dot(n, v)) / (4 * kPi * double(0.2f) * double(0.5f)) *
                   std::exp(-2 * (x * x + y * y) / (1 + dot(h, n)));
  const Frame frame = render(s.scene, s.assets, RenderPath::kAnalytic);
  EXPECT_NEAR(frame.colour.at(30, 30)[0], 0.3 * lit + 0.6 * f * lit, 1e-6);
}

// On a mesh whose texture coordinates are mirrored in u, t points to −x and b, which is not n × t then, still up.
TEST(ReflectancePaths, MirroredTextureCoordinatesTurnTheTangentAlone) {
  const ScratchDir dir;
  write_bytes(dir / "mirrored.obj",
              "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nvt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n"
              "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  ReflectanceMaps maps = one_texel();
  maps.bumpy = true, maps.material.n = {Vec3f(Vec3d{0.48, 0.36, 0.8})};
  maps.material.t = {Vec3f(orthonormal_frame({0.48, 0.36, 0.8}, {1, 0, 0})->t)};
  ReflectiveScene s = reflective(ReflectanceModel::kBanks, maps);
  s.scene.objects[0].surface.type = SurfaceType::kMesh;
  s.scene.objects[0].reflectance->specular = {};
  s.assets.mesh = std::make_shared<const MeshSurface>(read_mesh(dir / "mirrored.obj"), MeshShading::kSmooth);
  s.scene.lights[0].direction = {-0.48, 0.36, 0.8};
  for (const RenderPath path : {RenderPath::kAnalytic, RenderPath::kBanks})
    EXPECT_NEAR(render(s.scene, s.assets, path).colour.at(30, 30)[0], 0.3, 1e-6) << name(path);
}

// Directions that were made orthogonal to normals beforehand lean out of the plane, with no normal map to say so.
TEST(ReflectancePaths, DirectionsMadeOrthogonalBeforehandKeepTheirLean) {
  ReflectanceMaps maps = bumpy_maps(64, 0.8, 1, 1);
  maps.bumpy = false, maps.directions = maps.material.t;
  for (std::size_t i = 0; i < maps.directions.size(); i++) {
    const Vec3d up{0, 0, 1};
    maps.material.n[i] = Vec3f(up), maps.material.t[i] = Vec3f(orthonormal_frame(up, Vec3d(maps.directions[i]))->t);
  }
  EXPECT_GE(psnr_db(reflective(ReflectanceModel::kStrand, maps), RenderPath::kStrandPs11), 60);
}

TEST(ReflectancePaths, TablesOfAnotherFunctionOrTooSmallADomainAreRefused) {
  const auto refused = [](ReflectanceModel model, RenderPath path, LookupFunction f, const std::string& why) {
    ReflectiveScene s = reflective(model, bumpy_maps(4, 0.3, 0.5, 0.8));
    const bool strand = f.kind == LookupKind::kStrand;
    const LookupTable table =
        bake_table(f, 4, f.arguments() > 1 ? 4 : 1, strand ? TableSampling::kCentre : TableSampling::kEdge,
                   strand ? TableLayout::kCubeZ : TableLayout::kPlain);
    s.scene.tables[f.kind] = {"t.exr", std::make_shared<const TableFile>(TableFile{f, table})};
    EXPECT_ERROR(render(s.scene, s.assets, path), ErrorKind::kMalformed, "'t.exr': expected a table of " + why);
  };
  const auto function = [](LookupKind kind, std::vector<Range> domain = {}) {
    LookupFunction f;
    f.kind = kind, f.domain = domain.empty() ? default_domain(kind) : domain;
    return f;
  };
  using Model = ReflectanceModel;
  LookupFunction approximate = function(LookupKind::kBanksR);
  approximate.approximate = true;
  refused(Model::kBanks, RenderPath::kBanks, approximate, "R(s), as path 'banks' looks it up, got R*(s)");
  refused(Model::kBanks, RenderPath::kBanks, function(LookupKind::kBanksR, {{0, 0.5}}), "a domain that holds 0:1");
  // bumpy_maps() has N = 40.
  refused(Model::kBlinnPhong, RenderPath::kBlinnPhong, function(LookupKind::kBlinnPhongF, {{1, 8}, {0, 1}}),
          "a domain that holds 40:40, as path 'blinn-phong' looks it up, got 1:8");
  refused(Model::kBlinnPhong, RenderPath::kBlinnPhong, function(LookupKind::kBlinnPhongF, {{1, 128}, {0.1, 1}}),
          "a domain that holds 0:1");
  refused(Model::kWard, RenderPath::kWard, function(LookupKind::kWardS, {{0.1, 0.9}}), "a domain that holds 1:1");
  refused(Model::kWard, RenderPath::kWard, function(LookupKind::kWardE, {{1, 16}, {0, 1}}), "a domain that holds 0:0");
  LookupFunction strand = function(LookupKind::kStrand);
  strand.exponent = 50;
  refused(Model::kStrand, RenderPath::kStrandBump, strand, "exponent 16, as path 'strand-bump' looks it up, got 50");
}

TEST(ReflectancePaths, CombinersRefuseTexturesOfSeveralRanges) {
  ReflectiveScene s = reflective(ReflectanceModel::kBlinnPhongEquation1, bumpy_maps(4, 0.3, 0.5, 0.8), false, true);
  s.assets.textures->b.scale = {4, 4, 4, 128}, s.assets.textures->b.bias = {-2, -2, -2, 0};
  EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kCombiner), ErrorKind::kMalformed, "in the combiners' range");
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
  refused(RenderPath::kStrandBump, "strand.exr': expected a table of the layout cube-z, as path 'strand-bump' looks it up");
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
