#include "burnish/mesh/mesh_rays.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "expect_error.h"

namespace burnish {
namespace {

// Random triangles around the origin.
Mesh soup(int count) {
  std::mt19937 random(7);
  const auto coordinate = [&] { return double(random() % 20001) / 10000 - 1; };
  Mesh mesh;
  for (int i = 0; i < count; i++) {
    const Vec3d at{coordinate(), coordinate(), coordinate()};
    for (int c = 0; c < 3; c++) mesh.positions.push_back(at + Vec3d{coordinate(), coordinate(), coordinate()} * 0.3);
    mesh.triangles.push_back({std::uint32_t(3 * i), std::uint32_t(3 * i + 1), std::uint32_t(3 * i + 2)});
  }
  return mesh;
}

// Möller and Trumbore over all triangles.
std::optional<RayHit> first_of_all(const Mesh& m, Vec3d o, Vec3d d, double most, Facing facing) {
  std::optional<RayHit> best;
  for (std::uint32_t t = 0; t < m.triangles.size(); t++) {
    const Vec3d a = m.position(t, 0), e1 = m.position(t, 1) - a, e2 = m.position(t, 2) - a, p = cross(d, e2);
    const double det = dot(e1, p);
    if (det == 0 || (facing == Facing::kFront && det < 0) || (facing == Facing::kBack && det > 0)) continue;
    const double u = dot(o - a, p) / det, v = dot(d, cross(o - a, e1)) / det, at = dot(e2, cross(o - a, e1)) / det;
    if (u < 0 || v < 0 || u + v > 1 || at < 0 || at > most || (best && at >= best->t)) continue;
    best = RayHit{{t, {1 - u - v, u, v}}, at};
  }
  return best;
}

TEST(MeshRays, FirstHitsAreThoseOfASearchOverAllTriangles) {
  const Mesh mesh = soup(300);
  const MeshRays rays(mesh);
  std::mt19937 random(1);
  const auto coordinate = [&] { return double(random() % 20001) / 10000 - 1; };
  int hits = 0;
  for (int i = 0; i < 9000; i++) {
    const Vec3d origin = Vec3d{coordinate(), coordinate(), coordinate()} * 2.0,
                direction = Vec3d{coordinate(), coordinate(), coordinate()} * 3.0;
    const Facing facing = i % 3 == 0 ? Facing::kFront : i % 3 == 1 ? Facing::kBack : Facing::kEither;
    const auto expected = first_of_all(mesh, origin, direction, 0.8, facing);
    const auto got = rays.first_hit(origin, direction, 0, 0.8, facing);
    ASSERT_EQ(got.has_value(), expected.has_value()) << i;
    if (!got) continue;
    hits++;
    EXPECT_EQ(got->point.triangle, expected->point.triangle);
    EXPECT_NEAR(got->t, expected->t, 1e-9);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(got->point.weight[c], expected->point.weight[c], 1e-6);
    EXPECT_LT(length(position_at(mesh, got->point) - (origin + direction * got->t)), 1e-9);
  }
  EXPECT_GT(hits, 500);
}

TEST(MeshRays, NearestPointsAreThoseOfADenseSampling) {
  const Mesh mesh = soup(40);
  const MeshRays rays(mesh);
  std::mt19937 random(3);
  const auto coordinate = [&] { return double(random() % 20001) / 10000 - 1; };
  for (int i = 0; i < 100; i++) {
    const Vec3d from = Vec3d{coordinate(), coordinate(), coordinate()} * 2.0;
    double sampled = 1e9;
    constexpr int kSteps = 40;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); t++)
      for (int a = 0; a <= kSteps; a++)
        for (int b = 0; a + b <= kSteps; b++) {
          const double u = double(a) / kSteps, v = double(b) / kSteps;
          sampled = std::min(sampled, length(position_at(mesh, {t, {1 - u - v, u, v}}) - from));
        }
    const auto got = rays.nearest(from, 10);
    ASSERT_TRUE(got);
    EXPECT_NEAR(length(position_at(mesh, got->point) - from), got->distance, 1e-12);
    EXPECT_LE(got->distance, sampled + 1e-12);
    EXPECT_GT(got->distance, sampled - 0.02);
    EXPECT_FALSE(rays.nearest(from, got->distance * 0.999));
  }
}

TEST(MeshRays, TheNearestPointMayHaveToFaceADirection) {
  const Mesh mesh = soup(200);
  const MeshRays rays(mesh);
  const Vec3d from{0.1, 0.2, 0.3};
  for (Vec3d direction : {Vec3d{1, 0, 0}, Vec3d{0, -1, 1}, Vec3d{-1, 1, 1}}) {
    const auto facing = rays.nearest(from, 10, direction), opposite = rays.nearest(from, 10, -direction),
               any = rays.nearest(from, 10);
    ASSERT_TRUE(facing && opposite && any);
    EXPECT_GT(dot(mesh.perpendicular(facing->point.triangle), direction), 0);
    EXPECT_LT(dot(mesh.perpendicular(opposite->point.triangle), direction), 0);
    EXPECT_EQ(any->distance, std::min(facing->distance, opposite->distance));
  }
}

TEST(MeshRays, WhatHasNoAreaIsNeitherMetNorNear) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 0, 1}, {1e30, 1e30, 0}};
  mesh.triangles = {{3, 4, 5}, {3, 3, 4}, {0, 1, 2}};  // the last position is of none
  const MeshRays rays(mesh);
  EXPECT_FALSE(rays.first_hit({0.5, -1, 1}, {0, 1, 0}, 0, 10));
  for (const Vec3d from : {Vec3d{0.25, 0, 1}, Vec3d{1e30, 0, 0}}) {
    const auto near = rays.nearest(from, std::numeric_limits<double>::max());
    ASSERT_TRUE(near);
    EXPECT_EQ(near->point.triangle, 2u);
  }
  mesh.triangles.pop_back();
  EXPECT_FALSE(MeshRays(mesh).nearest({0.25, 0, 1}, 10));
  mesh.triangles.push_back({0, 1, 6});
  mesh.name = "far.obj";
  EXPECT_ERROR(MeshRays{mesh}, ErrorKind::kMalformed, "'far.obj': expected coordinates below 1e18");
}

TEST(MeshRays, NoRayPassesBetweenTrianglesThatShareAnEdge) {
  Mesh fan;  // twenty triangles around a point
  fan.positions.push_back({0, 0, 0.2});
  for (int i = 0; i < 20; i++) fan.positions.push_back({std::cos(i * kPi / 10), std::sin(i * kPi / 10), 0});
  for (std::uint32_t i = 0; i < 20; i++) fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 20});
  const MeshRays rays(fan);
  for (int i = 0; i < 20; i++)
    for (int k = 0; k < 50; k++) {
      const Vec3d on_edge = fan.positions[1 + i] * (k / 51.0);
      EXPECT_TRUE(rays.first_hit(on_edge + Vec3d{0, 0, 5}, {0, 0, -1}, 0, 100, Facing::kFront)) << i << ' ' << k;
    }
}

}  // namespace
}  // namespace burnish
