#include <gtest/gtest.h>

#include "burnish/brdf/light_factor.h"
#include "burnish/brdf/model_brdf.h"
#include "burnish/ptm/brdf/fit_brdf.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/round_ptm.h"
#include "burnish/render/picture.h"
#include "expect_error.h"
#include "reflectance_fixture.h"

namespace burnish {
namespace {

using testing::quad_scene;
using testing::render;
using testing::sphere_scene;
using testing::table_of;

// As the files are read: values of 255 become 1.
PtmTexture texture_of(const Ptm& ptm) {
  const int polynomials = ptm.polynomials() * kPtmTerms;
  PtmTexture out{ptm.type, Image(ptm.width, ptm.height, polynomials + ptm.colours()), {}, {}};
  out.scale.fill(1);
  for (std::size_t i = 0; i < ptm.texels(); i++) {
    float* to = out.stored.data.data() + i * out.stored.channels;
    for (int k = 0; k < polynomials; k++) to[k] = ptm.coefficients[i * polynomials + k] / 255;
    for (int c = 0; c < ptm.colours(); c++) to[polynomials + c] = ptm.colour[i * 3 + c] / 255;
  }
  return out;
}
PtmTexture texture_of(const PtmBytes& bytes) {
  PtmTexture out = texture_of(Ptm{bytes, {bytes.coefficients.begin(), bytes.coefficients.end()}, {}});
  for (int k = 0; k < kPtmTerms; k++) out.scale[k] = bytes.scale[k], out.bias[k] = bytes.bias[k] / 255.0;
  return out;
}

struct PtmScene {
  Scene scene;
  ObjectAssets assets;
  Vec3d pixel(RenderPath path, int x = 0, int y = 0) const {
    const Frame f = render(scene, assets, path);
    const float* c = f.colour.at(x, y);
    return {c[0], c[1], c[2]};
  }
};

// A quad of one texel a pixel.
PtmScene spatial(const Ptm& ptm, Vec3d light, bool srgb = false) {
  PtmScene s{quad_scene(ptm.width), {}};
  s.scene.objects[0].normal_map.clear();
  s.scene.objects[0].ptm = PtmSource{"map.ptm", "", "", {}, srgb};
  s.scene.tables[LookupKind::kLightFactor] = table_of(LookupKind::kLightFactor, 1024, 1);
  s.scene.lights[0].direction = normalized(light);
  s.assets.ptm.emplace();
  s.assets.ptm->map = s.assets.ptm->reference = texture_of(ptm);
  return s;
}

PtmScene brdf_scene(const std::string& model, const PtmTexture& map, double noise_factor) {
  PtmScene s{sphere_scene(64), {}};
  s.scene.objects[0].normal_map.clear();
  s.scene.objects[0].ptm = PtmSource{"map/", "", model, {}, false};
  s.scene.tables[LookupKind::kLightFactor] = table_of(LookupKind::kLightFactor, 1024, 1);
  s.scene.lights[0].direction = normalized(Vec3d{-0.4, 0.5, 1});
  s.assets.ptm = PtmAssets{map, {}, model_brdf(model), BrdfCoordinates::kHalfDifference, noise_factor};
  return s;
}

// Two by two texels that differ in all terms and colours.
Ptm four(PtmType type) {
  Ptm ptm{{type, 2, 2}, {}, {}};
  for (int i = 0; i < 4 * ptm.polynomials() * kPtmTerms; i++) ptm.coefficients.push_back(float(30 + 11 * i % 97));
  for (int i = 0; i < 4 * ptm.colours(); i++) ptm.colour.push_back(float(250 - 17 * i));
  return ptm;
}

void expect_near(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " "
                                      << b.z;
}

TEST(RenderPtm, ATexelIsItsPolynomialOfTheLight) {
  const Vec3d l = normalized(Vec3d{0.4, -0.3, 0.8});
  for (const PtmType type : {PtmType::kRgb, PtmType::kLrgb}) {
    const Ptm ptm = four(type);
    for (const bool srgb : {false, true}) {
      PtmScene s = spatial(ptm, l, srgb);
      s.scene.lights[0].colour = {1, 0.5, 2};
      for (int i = 0; i < 4; i++) {
        const auto lit = ptm.lit(i, float(l.x), float(l.y));
        const auto wanted = [&](int c) { return srgb ? linear_from_srgb(lit[c] / 255) : lit[c] / 255; };
        for (const RenderPath path : {RenderPath::kPtm, RenderPath::kAnalytic})
          expect_near(s.pixel(path, i % 2, i / 2), {wanted(0), wanted(1) * 0.5, wanted(2) * 2}, 2e-6);
      }
    }
  }
}

TEST(RenderPtm, TheLightFactorPlaysItsFourRoles) {
  Ptm ptm{{PtmType::kRgb, 1, 1}, {}, {}};
  for (int c = 0; c < 3; c++)
    for (const float a : {0.f, 0.f, 0.f, 0.f, 0.f, 255.f}) ptm.coefficients.push_back(a);
  for (const double z : {-0.9, -0.1, 0.05, 0.125, 0.2, 0.5, 1.0}) {
    const PtmScene s = spatial(ptm, {std::sqrt(1 - z * z), 0, z});
    const double wanted = light_factor(z, 1, 0.1, 0.25);
    expect_near(s.pixel(RenderPath::kAnalytic), Vec3d{1, 1, 1} * wanted, 1e-6);
    expect_near(s.pixel(RenderPath::kPtm), Vec3d{1, 1, 1} * wanted, 1e-3);
  }
  PtmScene coloured = spatial(ptm, {0, 0, 1});
  TableFile red = *coloured.scene.tables[LookupKind::kLightFactor].table;
  red.function.light = {2, 0.5, 0};
  red.table = bake_table(red.function, 256, 1, TableSampling::kEdge, TableLayout::kPlain);
  coloured.scene.tables[LookupKind::kLightFactor].table = std::make_shared<const TableFile>(red);
  for (const RenderPath path : {RenderPath::kPtm, RenderPath::kAnalytic})
    expect_near(coloured.pixel(path), {2, 0.5, 0}, 1e-6);
}

TEST(RenderPtm, WhatIsBelowZeroIsBlackAndLightsAddUp) {
  Ptm ptm{{PtmType::kRgb, 1, 1}, {}, {}};
  for (int c = 0; c < 3; c++)
    for (const float a : {0.f, 0.f, 0.f, 510.f, 0.f, 0.f}) ptm.coefficients.push_back(a);
  PtmScene s = spatial(ptm, {-0.6, 0, 0.8});
  expect_near(s.pixel(RenderPath::kPtm), {}, 0);
  s.scene.lights.push_back(s.scene.lights[0]);
  s.scene.lights[1].direction = {0.6, 0, 0.8};
  s.scene.lights.push_back(s.scene.lights[1]);
  for (const RenderPath path : {RenderPath::kPtm, RenderPath::kAnalytic})
    expect_near(s.pixel(path), Vec3d{2, 2, 2} * 1.2, 1e-5);
}

TEST(RenderPtm, ThePathHasTheBytesAndTheTwinTheReference) {
  Ptm ptm = four(PtmType::kRgb);
  PtmScene s = spatial(ptm, {0.3, 0.2, 1});
  const PtmBytes bytes = rounded(PtmInMemory(ptm), uniform_normal_matrix());
  s.assets.ptm->map = texture_of(bytes);
  const Ptm as_bytes = decoded(bytes);
  const Vec3d l = s.scene.lights[0].direction;
  for (int i = 0; i < 4; i++) {
    const auto lit = as_bytes.lit(i, float(l.x), float(l.y)), exact = ptm.lit(i, float(l.x), float(l.y));
    expect_near(s.pixel(RenderPath::kPtm, i % 2, i / 2), Vec3d{lit[0], lit[1], lit[2]} / 255.0, 1e-5);
    expect_near(s.pixel(RenderPath::kAnalytic, i % 2, i / 2), Vec3d{exact[0], exact[1], exact[2]} / 255.0, 1e-5);
  }
}

TEST(RenderPtmBrdf, WardIsNearItsFormula) {
  const std::string model = "ward:ax=0.3,ay=0.5,ks=0.7,kd=0.2";
  const Ptm fitted = fit_brdf(*model_brdf(model), {BrdfCoordinates::kHalfDifference, LightWeights::kProjected, 64});
  for (const double noise_factor : {1.0, 0.9}) {
    const PtmScene s =
        brdf_scene(model, texture_of(rounded(PtmInMemory(fitted), uniform_normal_matrix())), noise_factor);
    const Frame a = render(s.scene, s.assets, RenderPath::kPtmBrdf),
                b = render(s.scene, s.assets, RenderPath::kAnalytic);
    EXPECT_GT(compare(a.colour, b.colour, b.covered).psnr_db, noise_factor == 1 ? 38 : 30) << noise_factor;
  }
}

TEST(RenderPtmBrdf, AConstantMapShowsTheLightFactorAlone) {
  Ptm ptm{{PtmType::kRgb, 1, 1}, {}, {}};
  for (int c = 0; c < 3; c++)
    for (const float a : {0.f, 0.f, 0.f, 0.f, 0.f, 51.f}) ptm.coefficients.push_back(a);
  const PtmScene s = brdf_scene("ward:", texture_of(ptm), 0.9);
  const Frame f = render(s.scene, s.assets, RenderPath::kPtmBrdf, {Aov::kNormal});
  for (std::size_t i = 0; i < f.covered.data.size(); i++) {
    if (!f.covered.data[i]) continue;
    const float* n = &f.aovs[0].data[3 * i];
    const double c = dot(Vec3d{n[0], n[1], n[2]}, s.scene.lights[0].direction);
    EXPECT_NEAR(f.colour.data[3 * i], 0.2 * light_factor(c, 1, 0.1, 0.25), 1e-3);
  }
}

// Texel (1, 0) of 2 × 2 is where T·H is high and B·H low: seen on a sphere, whose T points right and B up.
TEST(RenderPtmBrdf, RowsRunFromLowBToHigh) {
  Ptm ptm{{PtmType::kRgb, 2, 2}, std::vector<float>(4 * 3 * kPtmTerms), {}};
  for (int c = 0; c < 3; c++) ptm.coefficients[(3 + c) * kPtmTerms + 5] = 255;
  PtmScene s = brdf_scene("ward:", texture_of(ptm), 1);
  s.scene.lights[0].direction = {0, 0, 1};  // H is the view
  const Frame f = render(s.scene, s.assets, RenderPath::kPtmBrdf);
  const auto at = [&](int x, int y) { return *f.colour.at(x, y); };
  // H leans to +T where the surface leans to the left, and to −B where it leans up.
  EXPECT_GT(at(16, 16), 0.3);
  EXPECT_LT(at(48, 16), at(16, 16) / 2);
  EXPECT_LT(at(16, 48), at(16, 16) / 2);
  EXPECT_LT(at(48, 48), at(16, 16) / 2);
}

TEST(RenderPtm, PathsRefuseWhatIsNotTheirs) {
  PtmScene s = spatial(four(PtmType::kRgb), {0, 0, 1});
  EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kPtmBrdf), ErrorKind::kMalformed,
               "path 'ptm-brdf' needs a BRDF PTM, and the quad has no 'brdf'");
  EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kWard), ErrorKind::kMalformed, "needs an [object.reflectance]");
  s.scene.objects[0].ptm->brdf = "ward:";
  EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kPtm), ErrorKind::kMalformed,
               "path 'ptm' needs a spatial map, and the quad has a BRDF PTM");
  TableFile high = *s.scene.tables[LookupKind::kLightFactor].table;
  high.function.domain[0] = {0.2, 1};
  s.scene.tables[LookupKind::kLightFactor].table = std::make_shared<const TableFile>(high);
  EXPECT_ERROR(render(s.scene, s.assets, RenderPath::kPtm), ErrorKind::kMalformed,
               "expected a domain that holds the transition, 0:0.25, got 0.2:1");
  s.scene.tables.clear();
  for (const RenderPath path : {RenderPath::kPtm, RenderPath::kAnalytic})
    EXPECT_ERROR(render(s.scene, s.assets, path), ErrorKind::kMalformed, "needs the table of light-factor");
}

}  // namespace
}  // namespace burnish
