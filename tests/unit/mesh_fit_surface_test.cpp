#include <gtest/gtest.h>

#include "../mesh_patterns.h"
#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/simplify/fit_surface.h"

namespace burnish {
namespace {

double rms_distance(const Mesh& from, const Mesh& to) {
  const MeshRays rays(to);
  double squares = 0;
  for (const Vec3d& p : from.positions) {
    const double d = rays.nearest(p, 1e9)->distance;
    squares += d * d;
  }
  return std::sqrt(squares / double(from.positions.size()));
}

TEST(FitSurface, BringsASurfaceToThePointsOfAnother) {
  // Without bends there is nothing that a plane could not reach.
  const auto sheet = [](int n, double height, double tilt) {
    return without_uvs(grid_mesh(
        n, n,
        [=](double u, double v) {
          return Vec3d{u, v, height + tilt * u};
        },
        identity_uv));
  };
  const Mesh high = sheet(20, 0.3, 0.2);
  Mesh low = sheet(3, 0, 0);
  fit_surface(low, high);
  EXPECT_LT(rms_distance(high, low), 1e-3);
  EXPECT_LT(rms_distance(low, high), 1e-3);
}

TEST(FitSurface, GoesThroughASphereInsteadOfInsideIt) {
  const Mesh high = without_uvs(named_mesh("sphere", 48));
  Mesh low = without_uvs(named_mesh("sphere", 8));
  const double before = rms_distance(high, low);
  const Mesh original = low;
  fit_surface(low, high);
  EXPECT_LT(rms_distance(high, low), 0.5 * before);
  EXPECT_EQ(low.triangles, original.triangles);
  double outside = 0;
  for (const Vec3d& p : low.positions) outside += length(p) > 1.001;
  EXPECT_GT(outside, 0.9 * double(low.positions.size()));
  // The seam of the file's indices stays closed.
  for (std::size_t i = 0; i < low.positions.size(); i++)
    for (std::size_t j = 0; j < i; j++)
      if (original.positions[i] == original.positions[j]) {
        EXPECT_EQ(low.positions[i], low.positions[j]);
      }
}

TEST(FitSurface, LeavesWhatFitsAlone) {
  const Mesh high = without_uvs(named_mesh("torus", 12));
  Mesh low = high;
  fit_surface(low, high);
  for (std::size_t i = 0; i < low.positions.size(); i++) EXPECT_LT(length(low.positions[i] - high.positions[i]), 1e-6);
}

TEST(FitSurface, TurnsNoTriangleOverAndKeepsCrowdedEdgesInPlace) {
  // Three sheets on the line x = z = 0, and points far off one side of them.
  Mesh low;
  for (const double angle : {0.0, 2.0, 4.0}) {
    const Mesh sheet = without_uvs(grid_mesh(
        3, 3,
        [=](double u, double v) {
          return Vec3d{u * std::cos(angle), v, u * std::sin(angle)};
        },
        identity_uv));
    const std::uint32_t first = std::uint32_t(low.positions.size());
    for (const Vec3d& p : sheet.positions) low.positions.push_back(p);
    for (const Corners& t : sheet.triangles) low.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const Mesh before = low;
  Mesh high = without_uvs(named_mesh("sphere", 20));
  for (Vec3d& p : high.positions) p = p * 0.7 + Vec3d{0.3, 0.2, 0.4};
  fit_surface(low, high);
  bool moved = false;
  for (std::size_t i = 0; i < low.positions.size(); i++) {
    const Vec3d was = before.positions[i];
    if (was.x == 0 && was.z == 0) {
      EXPECT_EQ(low.positions[i], was);
    }
    moved |= low.positions[i] != was;
  }
  EXPECT_TRUE(moved);
  for (std::size_t t = 0; t < low.triangles.size(); t++)
    EXPECT_LT(degrees(angle_rad(low.perpendicular(t), before.perpendicular(t))), 60 + 1e-6) << t;
}

}  // namespace
}  // namespace burnish
