// The lighting models and blendings against closed forms.
#include <gtest/gtest.h>

#include "burnish/render/blend.h"
#include "burnish/render/lighting/material.h"
#include "expect_error.h"
#include "render_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

constexpr Vec3d kUp{0, 0, 1};  // normal of most cases

// A direction tilted from +z towards +x.
Vec3d tilted(double deg) { return {std::sin(radians(deg)), 0, std::cos(radians(deg))}; }

Shaded shade(const LightingModel& model, Vec3d n, Vec3d to_light, Vec3d to_viewer, Vec3d ambient = {}) {
  const Arriving light{to_light, {1, 1, 1}};
  return Material{{}, {model}}.shade(n, {{&light, 1}, ambient, to_viewer});
}

template <typename Model = Phong>
double highlight(double light_deg, double view_deg, double exponent) {
  return shade(testing::glossy<Model>({}, {}, {1, 1, 1}, exponent).terms[0], kUp, tilted(light_deg), tilted(view_deg))
      .specular.x;
}

TEST(RenderLighting, LambertIsTheCosineAndAmbientLightAdds) {
  const Lambert model{{0.5, 1, 2}, {1, 0.5, 0.25}};
  const Shaded s = shade(model, kUp, tilted(60), kUp, {0.1, 0.1, 0.1});
  EXPECT_NEAR(s.diffuse.x, 0.05 + 0.5, 1e-12);
  EXPECT_NEAR(s.diffuse.y, 0.1 + 0.25, 1e-12);
  EXPECT_NEAR(s.diffuse.z, 0.2 + 0.125, 1e-12);
  EXPECT_EQ(s.specular, Vec3d{});
  EXPECT_EQ(shade(model, kUp, tilted(120), kUp).diffuse, Vec3d{}) << "not lit from below";
}

TEST(RenderLighting, PhongPeaksWhereTheMirroredLightMeetsTheView) {
  EXPECT_NEAR(highlight(30, -30, 50), 1, 1e-12);
  for (double off : {-10., 10.}) EXPECT_NEAR(highlight(30 + off, -30, 50), std::pow(std::cos(radians(10)), 50), 1e-12);
  EXPECT_EQ(highlight(90, 60, 50), 0) << "no highlight where the light grazes";
  EXPECT_EQ(highlight(180, 180, 50), 0) << "nor from behind";
}

TEST(RenderLighting, TheDoubledHighlightIsPhongsAtTwiceTheAngleAndEndsAt45Degrees) {
  for (double off : {0., 5., 20., 44.})
    EXPECT_NEAR(highlight<NprDouble>(30, -30 + off, 8), std::pow(std::cos(radians(2 * off)), 8), 1e-12) << off;
  for (double off : {46., 89., 95., 119.}) EXPECT_EQ(highlight<NprDouble>(30, -30 + off, 8), 0) << off;
}

TEST(RenderLighting, CartoonHasAsManyTonesAsBands) {
  Cartoon model;
  model.bands = 3;
  model.diffuse = {1, 0.5, 0}, model.shadow = {0.2, 0.1, 0};
  std::vector<double> tones;
  for (double deg = 0; deg <= 180; deg += 0.5) {
    const double tone = shade(model, kUp, tilted(deg), kUp).diffuse.x;
    if (tones.empty() || tones.back() != tone) tones.push_back(tone);
  }
  ASSERT_EQ(tones.size(), 3u);
  EXPECT_NEAR(tones[0], 1, 1e-12);
  EXPECT_NEAR(tones[1], 0.6, 1e-12);
  EXPECT_NEAR(tones[2], 0.2, 1e-12);
  EXPECT_NEAR(shade(model, kUp, tilted(48.1), kUp).diffuse.x, 1, 1e-12) << "cos 48.1° > 2/3";
  EXPECT_NEAR(shade(model, kUp, tilted(48.3), kUp).diffuse.x, 0.6, 1e-12);
  EXPECT_NEAR(shade(model, kUp, kUp, tilted(100)).diffuse.x, 1, 1e-12) << "no outline unless asked for";
  model.outline_cosine = 0.3, model.outline = {0, 0, 1};
  EXPECT_EQ(shade(model, kUp, kUp, tilted(80)).diffuse, (Vec3d{0, 0, 1}));
  EXPECT_EQ(shade(model, kUp, kUp, tilted(60)).diffuse.z, 0);
}

TEST(RenderLighting, ChromeIsBlueAboveAndBrownBelow) {
  const Chrome model;
  // The viewer along +z; a normal tilted from +z to +y by a mirrors the direction tilted by 2a.
  const auto seen = [&](double a) {
    return shade(model, {0, std::sin(radians(a)), std::cos(radians(a))}, kUp, kUp).specular;
  };
  EXPECT_LT(length(seen(45) - model.sky), 1e-12);
  EXPECT_LT(length(seen(-45) - model.nadir), 1e-12);
  for (double a = 1; a < 89; a++) EXPECT_GT(seen(a).z, seen(a).x) << "blue at " << a;
  for (double a = -1; a > -89; a--) EXPECT_GT(seen(a).x, seen(a).z) << "brown at " << a;
  const Vec3d half = seen(15);  // mirrors 30°: half way up
  EXPECT_NEAR(half.x, (model.sky.x + model.horizon.x) / 2, 1e-12);
}

TEST(RenderLighting, ThePanoramaIsMetWhereItsTexelsPoint) {
  Image image(8, 4, 3);
  for (std::size_t i = 0; i < image.texels(); i++) image.data[3 * i] = float(i);
  const Panorama panorama(image);
  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 8; x++) {
      const double turn = 2 * kPi * ((x + 0.5) / 8 - 0.5), lift = kPi * (0.5 - (y + 0.5) / 4);
      const Vec3d d{std::cos(lift) * std::sin(turn), std::sin(lift), -std::cos(lift) * std::cos(turn)};
      EXPECT_NEAR(panorama.at(d).x, 8 * y + x, 1e-9);
    }
  EXPECT_NEAR(panorama.at({1, 0, 0}).x, (8 * 1 + 5.5 + 8 * 2 + 5.5) / 2, 1e-9) << "three quarters round, to the right";
}

TEST(RenderLighting, AnEnvironmentShowsWhatTheMirrorSees) {
  Image image(64, 32, 1);
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 64; x++) *image.at(x, y) = y < 16 ? 1.f : 0.f;
  Environment model;
  model.panorama = std::make_shared<const Panorama>(image);
  model.specular = {0.5, 1, 2};
  const auto seen = [&](Vec3d n) { return shade(model, normalized(n), kUp, kUp).specular; };
  EXPECT_EQ(seen({0, 0.5, 1}), model.specular) << "mirrors the sky";
  EXPECT_EQ(seen({0, -0.5, 1}), Vec3d{}) << "mirrors the ground";
  *image.at(48, 15) = *image.at(47, 15) = *image.at(48, 16) = *image.at(47, 16) = 9;  // towards +x
  model.panorama = std::make_shared<const Panorama>(image);
  EXPECT_NEAR(seen({1, 0, 1}).y, 9, 1e-9);
  model.turn_rad = radians(90);  // the panorama's +x comes to −z, behind the object
  EXPECT_NEAR(seen({1, 1e-9, 1e-3}).y, 9, 0.1) << "a grazing mirror looks past the object";
}

TEST(RenderLighting, PanoramasOfTwoChannelsAndNaNAreRefused) {
  const testing::ScratchDir dir;
  Image two(2, 2, 2), bad(2, 2, 3);
  bad.data[5] = NAN;
  write_image(dir / "two.tif", FileType::kTiff, SampleType::kFloat, two);
  write_image(dir / "bad.exr", FileType::kExr, SampleType::kFloat, bad);
  EXPECT_ERROR(Panorama::read(dir / "two.tif"), ErrorKind::kMalformed, "1, 3 or 4 channels, got 2");
  EXPECT_ERROR(Panorama::read(dir / "bad.exr"), ErrorKind::kMalformed, "got nan");
}

TEST(RenderBlend, FollowsTheEquations) {
  const Vec3d c{0.8, 0.5, 0}, s{0.3, 0, 1};
  const double alpha = 0.6;
  const Shaded shaded{{alpha, alpha, alpha}, s};
  const Vec3d exact = blend(Blend::kExact, c, shaded), approximate = blend(Blend::kApproximate, c, shaded);
  EXPECT_NEAR(exact.x, 0.48 + 0.52 * 0.3, 1e-12);
  EXPECT_NEAR(exact.y, 0.3, 1e-12);
  EXPECT_NEAR(exact.z, 1, 1e-12);
  EXPECT_NEAR(approximate.x, 0.48 + 0.2 * 0.3, 1e-12);
  EXPECT_NEAR(approximate.y, 0.3, 1e-12);
  EXPECT_NEAR(approximate.z, 1, 1e-12);
  EXPECT_LT(length(blend(Blend::kMaterial, c, shaded) - Vec3d{0.9, 0.6, 1.6}), 1e-12);
}

TEST(RenderBlend, TheApproximationIsExactUnderFullLightAndDarkerOtherwise) {
  for (double alpha : {0.0, 0.3, 0.9, 1.0}) {
    const Vec3d c{0.7, 0.7, 0.7}, s{0.5, 0.5, 0.5};
    const double exact = blend_exact(c, alpha, s).x, approximate = blend_approximate(c, alpha, s).x;
    EXPECT_NEAR(exact - approximate, 0.7 * (1 - alpha) * 0.5, 1e-12);
  }
}

TEST(RenderTransform, NormalsStayPerpendicularUnderAnyStretch) {
  Transform t;
  t.rotation = rotation_xyz({0.3, -0.5, 1.1});
  t.scale = {3, 0.5, 1};
  const Vec3d a{1, 2, -1}, b{0.5, -1, 2}, n = cross(a, b);
  const auto direction = [&](Vec3d d) { return t.point_to_world(d) - t.point_to_world({}); };
  const Vec3d world = t.normal_to_world(n);
  EXPECT_NEAR(dot(world, direction(a)), 0, 1e-12);
  EXPECT_NEAR(dot(world, direction(b)), 0, 1e-12);
  EXPECT_NEAR(length(world), 1, 1e-12);
  EXPECT_GT(dot(world, cross(direction(a), direction(b))), 0);
  const Vec3d p{0.1, 0.2, 0.3};
  EXPECT_LT(length(t.point_to_object(t.point_to_world(p)) - p), 1e-15);
}

}  // namespace
}  // namespace burnish
