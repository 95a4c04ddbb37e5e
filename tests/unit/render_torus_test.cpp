#include <gtest/gtest.h>

#include <random>

#include "burnish/render/camera.h"
#include "burnish/render/surface.h"

namespace burnish {
namespace {

Surface torus(double radius = 0.35, double tube = 0.15) {
  Surface s;
  s.type = SurfaceType::kTorus;
  s.radius = radius, s.tube_radius = tube;
  return s;
}

Vec3d point(const Surface& s, double u, double v) {
  const double l = 2 * kPi * u, f = 2 * kPi * v, r = s.radius + s.tube_radius * std::cos(f);
  return {r * std::cos(l), r * std::sin(l), s.tube_radius * std::sin(f)};
}

// Signed distance to it.
double distance(const Surface& s, Vec3d p) { return std::hypot(std::hypot(p.x, p.y) - s.radius, p.z) - s.tube_radius; }

TEST(RenderTorus, RaysMeetItWhereSpheresOfFreeSpaceLead) {
  std::mt19937 random(1);
  const auto uniform = [&] { return double(random()) / 4294967296.0 * 2 - 1; };
  int hits = 0;
  for (const Surface& s : {torus(), torus(1, 0.05), torus(0.5, 0.49)})
    for (int i = 0; i < 2000; i++) {
      const Vec3d from{3 * uniform(), 3 * uniform(), 3 * uniform()};
      const Vec3d to = point(s, uniform(), uniform()) + Vec3d{uniform(), uniform(), uniform()} * 0.2;
      const double stretch = 0.1 + std::abs(uniform());
      const Vec3d d = normalized(to - from);
      if (distance(s, from) < 1e-3) continue;
      // Sphere tracing: no step can pass through.
      double t = 0;
      for (int k = 0; k < 100000 && t < 10 && distance(s, from + d * t) > 1e-9; k++) t += distance(s, from + d * t);
      const bool met = t < 10;
      const auto hit = intersect(s, {from, d * stretch, {}, {}, {}, {}});
      if (met && dot(hit ? hit->normal : d, d) > -1e-3) continue;  // it is grazed
      ASSERT_EQ(hit.has_value(), met) << i;
      if (!hit) continue;
      hits++;
      EXPECT_NEAR(hit->t * stretch, t, 1e-5);
      EXPECT_NEAR(distance(s, hit->position), 0, 1e-9);
      EXPECT_NEAR(length(point(s, hit->u, hit->v) - hit->position), 0, 1e-9);
      EXPECT_LT(dot(hit->normal, d), 0);
    }
  EXPECT_GT(hits, 2000);
}

TEST(RenderTorus, TheHoleAndTheInsideAreOpen) {
  const Surface s = torus();
  EXPECT_FALSE(intersect(s, {{0, 0, 2}, {0, 0, -1}, {}, {}, {}, {}}));
  EXPECT_FALSE(intersect(s, {{0.35, 0, 0}, {0, 0, 1}, {}, {}, {}, {}})) << "from the inside of the tube";
  const auto across = intersect(s, {{0.35, 0, 0}, {-1, 0, 0}, {}, {}, {}, {}});
  ASSERT_TRUE(across) << "out of the tube and over the hole";
  EXPECT_NEAR(across->t, 0.35 + 0.2, 1e-9);
  EXPECT_FALSE(intersect(s, {{0, 0, -2}, {0, 0, -1}, {}, {}, {}, {}})) << "behind";
}

TEST(RenderTorus, TheFrameFollowsTheCoordinates) {
  const Surface s = torus();
  constexpr double kStep = 1e-6;
  for (const double u : {0.05, 0.3, 0.6, 0.95})
    for (const double v : {0.02, 0.1, 0.2, 0.98}) {
      const Vec3d on = point(s, u, v), along_u = (point(s, u + kStep, v) - on) / kStep,
                  along_v = (point(s, u, v + kStep) - on) / kStep;
      const Vec3d n = normalized(cross(along_u, along_v));
      const auto hit = intersect(s, {on + n, -n, {}, {}, {}, {}});
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->u, u, 1e-9);
      EXPECT_NEAR(hit->v, v, 1e-9);
      EXPECT_NEAR(length(hit->tangent - normalized(along_u)), 0, 1e-5);
      EXPECT_NEAR(length(hit->bitangent - normalized(along_v)), 0, 1e-5);
      EXPECT_NEAR(length(hit->normal - n), 0, 1e-5);
    }
}

TEST(RenderTorus, DerivativesMatchDifferences) {
  for (CameraType type : {CameraType::kOrthographic, CameraType::kPerspective}) {
    CameraSettings settings;
    settings.type = type;
    settings.position = {0.7, 0.9, 2};
    const Camera camera(settings, 100, 80);
    const auto at = [&](double x, double y) { return *intersect(torus(), camera.ray(x, y)); };
    constexpr double kStep = 1e-4;
    const double i = 50, j = type == CameraType::kOrthographic ? 65 : 58;
    const SurfacePoint p = at(i, j), x = at(i + kStep, j), y = at(i, j + kStep);
    EXPECT_NEAR(p.du_dx, (x.u - p.u) / kStep, 1e-5);
    EXPECT_NEAR(p.dv_dx, (x.v - p.v) / kStep, 1e-5);
    EXPECT_NEAR(p.du_dy, (y.u - p.u) / kStep, 1e-5);
    EXPECT_NEAR(p.dv_dy, (y.v - p.v) / kStep, 1e-5);
  }
}

}  // namespace
}  // namespace burnish
