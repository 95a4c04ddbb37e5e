#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../mesh_patterns.h"
#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/simplify/decimate.h"
#include "expect_error.h"
#include "mesh_topology.h"

namespace burnish {
namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) sum += dot(mesh.position(t, 0), mesh.perpendicular(t)) / 6;
  return sum;
}

// A cube of side 2, each face n by n quads.
Mesh cube(int n) {
  Mesh out;
  for (int side = 0; side < 6; side++) {
    const Mesh face = grid_mesh(
        n, n,
        [&](double u, double v) {
          const Vec3d p{2 * u - 1, 2 * v - 1, 1};
          return side == 0   ? p
                 : side == 1 ? Vec3d{p.z, p.x, p.y}
                 : side == 2 ? Vec3d{p.y, p.z, p.x}
                 : side == 3 ? Vec3d{p.y, p.x, -p.z}
                 : side == 4 ? Vec3d{-p.z, p.y, p.x}
                             : Vec3d{p.x, -p.z, p.y};
        },
        identity_uv);
    const std::uint32_t first = std::uint32_t(out.positions.size());
    for (const Vec3d& p : face.positions) out.positions.push_back(p);
    for (const Corners& t : face.triangles) out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return out;
}

Mesh tetrahedron(Vec3d at) {
  Mesh mesh;
  mesh.positions = {at, at + Vec3d{1, 0, 0}, at + Vec3d{0, 1, 0}, at + Vec3d{0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

TEST(Decimate, ReachesTheNumberOnAClosedSurfaceAndKeepsItClosed) {
  const Mesh sphere = without_uvs(named_mesh("sphere", 70));
  const Mesh ring = without_uvs(named_mesh("torus", 40));
  for (const std::size_t faces : {2000, 500, 200, 100, 50}) {
    DecimateStats stats;
    const Mesh low = decimate(sphere, faces, &stats);
    EXPECT_EQ(low.triangles.size(), faces);
    EXPECT_EQ(stats.faces, faces);
    EXPECT_EQ(stats.vertices, faces / 2 + 2);
    EXPECT_TRUE(is_closed(low)) << faces;
    EXPECT_EQ(euler_characteristic(low), 2);
    EXPECT_EQ(euler_characteristic(decimate(ring, faces)), 0);
  }
  EXPECT_EQ(decimate(sphere, 201).triangles.size(), 200u);  // a closed surface has an even number
}

TEST(Decimate, KeepsTheShape) {
  // A sphere's best approximation with F triangles is off by about 2π/(√3·F)·r between its middle and its corners.
  const Mesh sphere = without_uvs(named_mesh("sphere", 70));
  for (const std::size_t faces : {2000, 500, 200}) {
    DecimateStats stats;
    const Mesh low = decimate(sphere, faces, &stats);
    const double sagitta = 2 * kPi / (std::sqrt(3.0) * double(faces));
    EXPECT_LT(stats.max_distance, 3 * sagitta) << faces;
    EXPECT_LT(stats.rms_distance, sagitta) << faces;
    EXPECT_NEAR(volume(low) / volume(sphere), 1, 6 / double(faces)) << faces;  // inscribed ones lose twice that
    for (std::size_t t = 0; t < low.triangles.size(); t++)
      EXPECT_GT(dot(low.perpendicular(t), low.position(t, 0)), 0) << "turned over";
  }
}

TEST(Decimate, KeepsCornersAndEdges) {
  DecimateStats stats;
  const Mesh low = decimate(cube(9), 12, &stats);
  EXPECT_EQ(low.triangles.size(), 12u);
  EXPECT_EQ(low.positions.size(), 8u);
  for (const Vec3d& p : low.positions)
    for (const double x : {p.x, p.y, p.z}) EXPECT_NEAR(std::abs(x), 1, 1e-6);
  EXPECT_LT(stats.max_distance, 1e-6);
}

TEST(Decimate, KeepsBordersAndMeetsOddNumbersThere) {
  const Mesh sheet = without_uvs(grid_mesh(30, 30, bumpy_sheet, identity_uv));
  for (const std::size_t faces : {301, 300, 101, 100, 40}) {
    DecimateStats stats;
    const Mesh low = decimate(sheet, faces, &stats);
    EXPECT_EQ(low.triangles.size(), faces);
    EXPECT_EQ(euler_characteristic(low), 1);
    double most = 0, corners = 0;
    for (const auto& [edge, count] : edge_uses(low)) {
      if (edge_uses(low).count({edge.second, edge.first})) continue;
      const Vec3d p = low.positions[edge.first];
      most = std::max(most, std::min({std::abs(p.x), std::abs(1 - p.x), std::abs(p.y), std::abs(1 - p.y)}));
      corners += std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)) > 0.49 &&
                 std::min(std::abs(p.x - 0.5), std::abs(p.y - 0.5)) > 0.49;
    }
    EXPECT_LT(most, 0.005) << faces;
    EXPECT_EQ(corners, 4) << faces;
  }
}

TEST(Decimate, AFlatSheetIsTwoTriangles) {
  const Mesh sheet = grid_mesh(
      12, 12,
      [](double u, double v) {
        return Vec3d{3 * u, v, 0.5 * u};
      },
      turned_uv);
  for (const bool textured : {false, true}) {
    DecimateStats stats;
    const Mesh low = decimate(textured ? sheet : without_uvs(sheet), 2, &stats);
    EXPECT_EQ(low.triangles.size(), 2u);
    EXPECT_EQ(low.positions.size(), 4u);
    EXPECT_LT(stats.max_distance, 1e-7);
  }
}

TEST(Decimate, WhatNothingCanBeTakenFromStays) {
  const Mesh two = joined(tetrahedron({0, 0, 0}), tetrahedron({5, 0, 0}));
  const Mesh low = decimate(two, 4);
  EXPECT_EQ(low.triangles.size(), 8u);
  EXPECT_TRUE(is_closed(low));
  const Mesh same = decimate(two, 100);
  EXPECT_EQ(same.triangles, two.triangles);
  EXPECT_EQ(same.positions, two.positions);
}

TEST(Decimate, CrowdedEdgesAndOppositeNeighboursStayInPlace) {
  // Three sheets on one edge, x = z = 0, the third the wrong way round.
  const auto sheet = [](double angle, bool turned) {
    return without_uvs(grid_mesh(
        8, 8,
        [=](double u, double v) {
          const double r = turned ? 1 - u : u;
          return Vec3d{r * std::cos(angle), v, r * std::sin(angle)};
        },
        identity_uv));
  };
  const Mesh fins = joined(joined(sheet(0, false), sheet(2, true)), sheet(4, false));
  const Mesh low = decimate(fins, 100);
  EXPECT_LE(low.triangles.size(), 150u);
  std::set<double> on_edge;
  for (const Vec3d& p : low.positions)
    if (std::abs(p.x) + std::abs(p.z) < 1e-12) on_edge.insert(p.y);
  EXPECT_EQ(on_edge.size(), 9u);
  for (const Vec3d& p : fins.positions) {
    const auto near = MeshRays(low).nearest(p, 1);
    ASSERT_TRUE(near);
    EXPECT_LT(near->distance, 1e-6);
  }
}

TEST(Decimate, TrianglesWithoutAreaDoNotMatter) {
  Mesh mesh = without_uvs(named_mesh("torus", 16));
  const std::size_t before = mesh.triangles.size();
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], mesh.triangles[0][0]});
  mesh.positions.push_back(mesh.position(5, 0));
  mesh.triangles.push_back({mesh.triangles[5][0], mesh.triangles[5][1], std::uint32_t(mesh.positions.size()) - 1});
  EXPECT_EQ(decimate(mesh, before).triangles.size(), before);
  EXPECT_TRUE(is_closed(decimate(mesh, 100)));
}

// A file may hold any; one at 1e30 is beyond the reach of a search in single precision.
TEST(Decimate, PositionsThatNoTriangleHasCountNowhere) {
  const Mesh mesh = without_uvs(named_mesh("torus", 16));
  Mesh more = mesh;
  more.positions.insert(more.positions.begin(), 2, {5, 5, 5});
  more.positions.push_back({1e30, 0, 0});
  for (Corners& t : more.triangles)
    for (std::uint32_t& i : t) i += 2;
  for (const std::size_t faces : {mesh.triangles.size(), std::size_t(100)}) {
    DecimateStats expected, got;
    const Mesh low = decimate(mesh, faces, &expected), same = decimate(more, faces, &got);
    EXPECT_EQ(got.max_distance, expected.max_distance);
    EXPECT_EQ(got.rms_distance, expected.rms_distance);
    for (std::size_t t = 0; t < faces; t++)
      for (int c = 0; c < 3; c++) EXPECT_EQ(same.position(t, c), low.position(t, c));
  }
}

TEST(Decimate, RefusesWhatSinglePrecisionCannotMeasure) {
  Mesh far = without_uvs(named_mesh("torus", 8));
  far.name = "far.obj";
  far.positions[far.triangles[0][0]].x = 1e30;
  for (const int faces : {50, 1000})
    EXPECT_ERROR(decimate(far, faces), ErrorKind::kMalformed, "'far.obj': expected coordinates below 1e18");
  Mesh line;
  line.name = "line.obj";
  line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}};
  DecimateStats stats;
  EXPECT_ERROR(decimate(line, 4, &stats), ErrorKind::kMalformed, "'line.obj': expected triangles with area");
}

TEST(Decimate, SaysHowFarTheOriginalIs) {
  const Mesh high = without_uvs(named_mesh("torus", 24));
  DecimateStats stats;
  const Mesh low = decimate(high, 120, &stats);
  // Distances to a dense sampling of the result, which are never less.
  double most = 0, squares = 0;
  for (const Vec3d& p : high.positions) {
    double least = 1e9;
    for (std::uint32_t t = 0; t < low.triangles.size(); t++)
      for (int i = 0; i <= 40; i++)
        for (int j = 0; i + j <= 40; j++)
          least = std::min(least, length(p - position_at(low, {t, {i / 40.0, j / 40.0, (40 - i - j) / 40.0}})));
    most = std::max(most, least), squares += least * least;
  }
  EXPECT_LE(stats.max_distance, most + 1e-12);
  EXPECT_NEAR(stats.max_distance, most, 0.1 * most);
  EXPECT_NEAR(stats.rms_distance, std::sqrt(squares / double(high.positions.size())), 0.2 * stats.rms_distance);
}

TEST(Decimate, NormalsAreSmooth) {
  const Mesh low = decimate(without_uvs(named_mesh("sphere", 40)), 300);
  ASSERT_EQ(low.triangle_normals.size(), low.triangles.size());
  for (std::size_t t = 0; t < low.triangles.size(); t++)
    for (int c = 0; c < 3; c++) EXPECT_LT(degrees(angle_rad(low.normal(t, c), low.position(t, c))), 8);
}

}  // namespace
}  // namespace burnish
