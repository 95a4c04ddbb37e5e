#include <gtest/gtest.h>

#include "burnish/render/camera.h"
#include "burnish/render/surface.h"
#include "render_fixture.h"

namespace burnish {
namespace {

using testing::constant_normals;
using testing::quad_scene;
using testing::render;
using testing::sphere_scene;

TEST(RenderSurface, QuadUvGrowsToTheRightAndUp) {
  const Scene s = quad_scene(4);
  const Frame f = render(s, constant_normals(s, {0, 0, 1}), RenderPath::kAnalytic, {Aov::kUv});
  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 4; x++) {
      EXPECT_NEAR(f.aovs[0].at(x, y)[0], (x + 0.5) / 4, 1e-6);
      EXPECT_NEAR(f.aovs[0].at(x, y)[1], 1 - (y + 0.5) / 4, 1e-6);
    }
}

TEST(RenderSurface, ATexelAPixelShowsTheMapAsItIs) {
  Scene s = quad_scene(8);
  ObjectAssets a = constant_normals(s, {0, 0, 1});
  a.width = a.height = 8;
  a.normals = testing::spread_normals(64, true);
  const Frame f = render(s, a, RenderPath::kAnalytic, {Aov::kNormal});
  for (std::size_t i = 0; i < 64; i++) EXPECT_EQ(f.aovs[0].data[3 * i], a.normals[i].x) << "texel " << i;
}

TEST(RenderSurface, SphereShowsTheMapsMiddleInFrontAndVUp) {
  Surface sphere;
  sphere.type = SurfaceType::kSphere;
  sphere.radius = 2;
  const auto at = [&](Vec3d p) {
    const auto hit = intersect(sphere, {p * 5.0, -p, {}, {}, {}, {}});
    EXPECT_TRUE(hit);
    return *hit;
  };
  EXPECT_NEAR(at({0, 0, 1}).u, 0.5, 1e-12);
  EXPECT_NEAR(at({0, 0, 1}).v, 0.5, 1e-12);
  EXPECT_NEAR(at({1, 0, 0}).u, 0.75, 1e-12);
  EXPECT_NEAR(at({-1, 0, 0}).u, 0.25, 1e-12);
  EXPECT_NEAR(at({0, 1, 0}).v, 1, 1e-12);
  EXPECT_NEAR(at({0, -1, 0}).v, 0, 1e-12);
  const SurfacePoint front = at(normalized(Vec3d{0.3, 0.2, 1}));
  EXPECT_NEAR(length(front.position), 2, 1e-12);
  EXPECT_GT(front.tangent.x, 0.9);
  EXPECT_GT(front.bitangent.y, 0.9);
  EXPECT_NEAR(length(cross(front.tangent, front.bitangent) - front.normal), 0, 1e-12) << "right-handed";
}

TEST(RenderSurface, TheFrameFollowsTheCoordinates) {
  Surface sphere;
  sphere.type = SurfaceType::kSphere;
  constexpr double kStep = 1e-6;
  for (const Vec3f& nf : testing::spread_normals(50, false)) {
    const Vec3d n = normalized(Vec3d(nf));
    const auto uv_at = [&](Vec3d p) { return *intersect(sphere, {p * 3.0, -p, {}, {}, {}, {}}); };
    const SurfacePoint p = uv_at(n);
    const SurfacePoint along_t = uv_at(normalized(n + p.tangent * kStep)),
                       along_b = uv_at(normalized(n + p.bitangent * kStep));
    EXPECT_GT(along_t.u, p.u);
    EXPECT_NEAR(along_t.v, p.v, 1e-9);
    EXPECT_GT(along_b.v, p.v);
    EXPECT_NEAR(along_b.u, p.u, 1e-9);
  }
}

// The derivatives against differences of neighbouring rays.
TEST(RenderSurface, DerivativesMatchDifferences) {
  for (CameraType type : {CameraType::kOrthographic, CameraType::kPerspective})
    for (SurfaceType surface_type : {SurfaceType::kQuad, SurfaceType::kSphere}) {
      Surface surface;
      surface.type = surface_type;
      CameraSettings settings;
      settings.type = type;
      settings.position = {0.7, 0.9, 2};
      const Camera camera(settings, 100, 80);
      const auto at = [&](double x, double y) { return *intersect(surface, camera.ray(x, y)); };
      constexpr double kStep = 1e-4;
      const SurfacePoint p = at(52, 41), x = at(52 + kStep, 41), y = at(52, 41 + kStep);
      EXPECT_NEAR(p.du_dx, (x.u - p.u) / kStep, 1e-6);
      EXPECT_NEAR(p.dv_dx, (x.v - p.v) / kStep, 1e-6);
      EXPECT_NEAR(p.du_dy, (y.u - p.u) / kStep, 1e-6);
      EXPECT_NEAR(p.dv_dy, (y.v - p.v) / kStep, 1e-6);
    }
}

TEST(RenderSurface, PerspectiveFieldOfViewSpansThePictureFromTopToBottom) {
  CameraSettings settings;
  settings.type = CameraType::kPerspective;
  settings.fov_deg = 90;
  settings.position = {0, 0, 1};
  const Camera camera(settings, 200, 100);
  const Ray top = camera.ray(100, 0), right = camera.ray(200, 50);
  EXPECT_NEAR(top.direction.y / -top.direction.z, 1, 1e-12);
  EXPECT_NEAR(right.direction.x / -right.direction.z, 2, 1e-12);
}

TEST(RenderSurface, OfTwoObjectsTheNearerIsSeen) {
  Scene s = quad_scene(1);
  s.objects.push_back(s.objects[0]);
  s.objects[1].transform.translation = {0, 0, 0.5};
  s.lights[0].direction = {0, 0, 1};
  const std::vector<ObjectAssets> assets{constant_normals(s, {0, 0, 1}), constant_normals(s, {0.6, 0, 0.8})};
  const Frame f = render_frame(s, assets, {RenderPath::kAnalytic, 1, 0, {Aov::kDepth}});
  EXPECT_NEAR(f.colour.data[0], 0.8, 1e-7);
  EXPECT_NEAR(f.aovs[0].data[0], 1.5, 1e-7);
}

}  // namespace
}  // namespace burnish
