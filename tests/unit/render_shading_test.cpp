// Closed forms: what a lit pixel must be.
#include <gtest/gtest.h>

#include "render_fixture.h"

namespace burnish {
namespace {

using testing::constant_normals;
using testing::quad_scene;
using testing::render;
using testing::sphere_scene;

Vec3d towards(double tilt_deg, double turn_deg = 0) {
  const double t = radians(tilt_deg), a = radians(turn_deg);
  return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

TEST(RenderShading, FlatMapLitAtAnAngleIsItsCosine) {
  for (double tilt : {0.0, 30.0, 60.0, 85.0}) {
    Scene s = quad_scene();
    s.lights[0].direction = towards(tilt, 20);
    const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
    for (float c : f.colour.data) ASSERT_NEAR(c, std::cos(radians(tilt)), 1e-7) << "tilt " << tilt;
  }
}

TEST(RenderShading, LightFromBelowLeavesOnlyTheAmbient) {
  Scene s = quad_scene();
  s.ambient = {0.1, 0.2, 0.3};
  s.materials[0] = testing::glossy({0.5, 0.5, 0.5}, {1, 1, 1}, {1, 1, 1}, 2);
  s.lights[0].direction = {0.6, 0, -0.8};
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_FLOAT_EQ(f.colour.data[0], 0.05f);
  EXPECT_FLOAT_EQ(f.colour.data[1], 0.10f);
  EXPECT_FLOAT_EQ(f.colour.data[2], 0.15f);
}

TEST(RenderShading, ColourIntensityAndMaterialMultiply) {
  Scene s = quad_scene();
  s.lights[0].colour = {1, 0.5, 0.25};
  s.lights[0].intensity = 2;
  s.materials[0].terms = {Lambert{{0, 0, 0}, {0.5, 0.5, 1}}};
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_FLOAT_EQ(f.colour.data[0], 1.f);
  EXPECT_FLOAT_EQ(f.colour.data[1], 0.5f);
  EXPECT_FLOAT_EQ(f.colour.data[2], 0.5f);
}

TEST(RenderShading, LightsAdd) {
  Scene s = quad_scene();
  s.lights[0].direction = towards(60);
  s.lights.push_back(s.lights[0]);
  s.lights[1].direction = towards(60, 180);
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_NEAR(f.colour.data[0], 1.0, 1e-7);
}

// A bump: the texel left of the middle leans to −x, the right one to +x, the upper one to +y, the lower one
// to −y.
ObjectAssets bump(const Scene& s) {
  ObjectAssets a = constant_normals(s, {0, 0, 1});
  a.width = a.height = 3;
  a.normals.assign(9, Vec3f{0, 0, 1});
  a.normals[3] = {-0.6f, 0, 0.8f}, a.normals[5] = {0.6f, 0, 0.8f};
  a.normals[1] = {0, 0.6f, 0.8f}, a.normals[7] = {0, -0.6f, 0.8f};
  return a;
}

TEST(RenderShading, ABumpIsBrightOnTheSideOfTheLight) {
  Scene s = quad_scene(3);
  const ObjectAssets a = bump(s);
  const auto at = [&](const Frame& f, int x, int y) { return f.colour.at(x, y)[0]; };
  s.lights[0].direction = towards(45, 0);  // from +x
  const Frame from_x = render(s, a, RenderPath::kAnalytic);
  EXPECT_GT(at(from_x, 2, 1), at(from_x, 1, 1));
  EXPECT_LT(at(from_x, 0, 1), at(from_x, 1, 1));
  s.lights[0].direction = towards(45, 90);  // from +y, the picture's top
  const Frame from_y = render(s, a, RenderPath::kAnalytic);
  EXPECT_GT(at(from_y, 1, 0), at(from_y, 1, 1));
  EXPECT_LT(at(from_y, 1, 2), at(from_y, 1, 1));
}

TEST(RenderShading, PhongHighlightTurnsTwiceAsFastAsTheNormal) {
  Scene s = quad_scene(1);
  s.materials[0] = testing::glossy({}, {}, {1, 1, 1}, 10);
  const Frame f = render(s, constant_normals(s, towards(15)), RenderPath::kAnalytic);  // light and view along +z
  EXPECT_NEAR(f.colour.data[0], std::pow(std::cos(radians(30)), 10), 1e-6);
}

TEST(RenderShading, ARotatedQuadTakesItsNormalsAlong) {
  Scene s = quad_scene(5);
  s.objects[0].transform.rotation = rotation_xyz({0, radians(40), 0});  // normal turns from +z towards +x
  s.lights[0].direction = towards(70);
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_NEAR(f.colour.at(2, 2)[0], std::cos(radians(30)), 1e-7);
  // A tangent-space normal leaning along +u leans further to +x.
  const Frame leaning = render(s, constant_normals(s, towards(20)), RenderPath::kAnalytic);
  EXPECT_NEAR(leaning.colour.at(2, 2)[0], std::cos(radians(10)), 1e-6);
}

TEST(RenderShading, TheBackOfAQuadIsNotThere) {
  Scene s = quad_scene(2);
  s.image.background = {0.25, 0.5, 0.75};
  s.objects[0].transform.rotation = rotation_xyz({0, radians(180), 0});
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_FLOAT_EQ(f.colour.data[0], 0.25f);
  EXPECT_FLOAT_EQ(f.colour.data[2], 0.75f);
  EXPECT_EQ(f.covered.data[0], 0);
}

TEST(RenderShading, ASphereOfItsOwnNormalsIsNDotL) {
  Scene s = sphere_scene(65);
  s.camera.height = 1.2;
  s.lights[0].direction = towards(50, 130);
  ObjectAssets a = constant_normals(s, {0, 0, 1});  // tangent space: the geometric normal itself
  const Frame f = render(s, a, RenderPath::kAnalytic);
  for (int y = 0; y < 65; y++)
    for (int x = 0; x < 65; x++) {
      const double px = (x - 32) * 1.2 / 65 / 0.5, py = (32 - y) * 1.2 / 65 / 0.5, r2 = px * px + py * py;
      if (r2 > 0.999) continue;
      const double expected = std::max(0.0, dot(Vec3d{px, py, std::sqrt(1 - r2)}, s.lights[0].direction));
      ASSERT_NEAR(f.colour.at(x, y)[0], expected, 1e-6) << x << ", " << y;
    }
}

TEST(RenderShading, PointLightsShineFromWhereTheyAre) {
  Scene s = quad_scene(1);
  s.lights[0].type = LightType::kPoint;
  s.lights[0].position = {1, 0, 1};
  const ObjectAssets flat = constant_normals(s, {0, 0, 1});
  EXPECT_NEAR(render(s, flat, RenderPath::kAnalytic).colour.data[0], std::sqrt(0.5), 1e-7);
  s.lights[0].falloff = Falloff::kInverseSquare;
  EXPECT_NEAR(render(s, flat, RenderPath::kAnalytic).colour.data[0], std::sqrt(0.5) / 2, 1e-7);
}

TEST(RenderShading, SamplesAverageAndThreadsDoNotMatter) {
  Scene s = quad_scene(1);
  s.camera.height = 2;  // the quad covers a quarter of the pixel
  s.samples = 4;
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic);
  EXPECT_FLOAT_EQ(f.colour.data[0], 0.25f);
  EXPECT_EQ(f.covered.data[0], 1);
}

TEST(RenderShading, TurnedLightsComeRound) {
  Scene s = quad_scene(1);
  s.turn_axis = {0, 1, 0};
  s.lights[0].direction = {1, 0, 0};
  const std::vector<ObjectAssets> flat{constant_normals(s, {0, 0, 1})};
  // Counter-clockwise seen from the axis's tip: +x goes to −z.
  const auto at = [&](double deg) {
    return render_frame(s, flat, {RenderPath::kAnalytic, 1, radians(deg), {}}).colour.data[0];
  };
  EXPECT_NEAR(at(90), 0, 1e-7);
  EXPECT_NEAR(at(270), 1, 1e-7);
  EXPECT_NEAR(at(330), std::cos(radians(60)), 1e-7);
}

// A disc of shade on the ground, below a sphere that a light from the side is kept off by.
TEST(RenderShading, ObjectsCastShadowsWhereTheSceneSaysSo) {
  Scene s = quad_scene(64);
  s.objects[0].normal_map.clear();
  s.objects.push_back(s.objects[0]);
  s.objects[1].surface.type = SurfaceType::kSphere;
  s.objects[1].surface.radius = 0.1;
  s.objects[1].transform.translation = {-0.3, 0, 0.3};
  const std::vector<ObjectAssets> assets(2, constant_normals(s, {0, 0, 1}));
  std::vector<ObjectAssets> bare = assets;
  for (ObjectAssets& a : bare) a.normals.clear();
  for (const LightType type : {LightType::kDirectional, LightType::kPoint}) {
    s.lights[0].type = type;
    s.lights[0].direction = normalized(Vec3d{-1, 0, 1}), s.lights[0].position = {-3, 0, 3};
    s.shadows = false;
    const Frame open = render_frame(s, bare, {RenderPath::kAnalytic, 1, 0, {}});
    s.shadows = true;
    const Frame cast = render_frame(s, bare, {RenderPath::kAnalytic, 1, 0, {}});
    int shaded = 0;
    for (int y = 0; y < 64; y++)
      for (int x = 0; x < 64; x++) {
        const Vec3d p{(x + 0.5) / 64 - 0.5, 0.5 - (y + 0.5) / 64, 0};
        const Vec3d centre = s.objects[1].transform.translation;
        if (std::hypot(p.x - centre.x, p.y) < 0.12) {  // the sphere is seen, which is lit as before
          EXPECT_EQ(*open.colour.at(x, y), *cast.colour.at(x, y));
          continue;
        }
        const Vec3d l = type == LightType::kPoint ? normalized(s.lights[0].position - p) : s.lights[0].direction;
        const bool blocked = length(cross(centre - p, l)) < 0.1;
        shaded += blocked;
        EXPECT_EQ(*cast.colour.at(x, y), blocked ? 0 : *open.colour.at(x, y)) << x << " " << y;
      }
    EXPECT_GT(shaded, 50);
  }
  s.lights[0].position = {-0.1, 0, 0.1};  // between ground and sphere: it shadows nothing there
  const Frame near = render_frame(s, bare, {RenderPath::kAnalytic, 1, 0, {}});
  EXPECT_GT(*near.colour.at(32, 32), 0);
}

}  // namespace
}  // namespace burnish
