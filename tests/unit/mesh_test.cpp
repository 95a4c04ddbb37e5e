#include "burnish/mesh/mesh.h"

#include <gtest/gtest.h>

#include "../mesh_patterns.h"
#include "burnish/mesh/simplify/decimate.h"

namespace burnish {
namespace {

TEST(Mesh, SmoothNormalsOfACubeWeldedOrNotPointOutOfItsCorners) {
  Mesh cube;
  for (int i = 0; i < 8; i++) cube.positions.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    cube.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
    cube.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[2]), std::uint32_t(f[3])});
  }
  Mesh split = cube;
  split.positions.clear();
  for (Corners& t : split.triangles)
    for (std::uint32_t& i : t) {
      split.positions.push_back(cube.positions[i]);
      i = std::uint32_t(split.positions.size() - 1);
    }
  for (Mesh* m : {&cube, &split}) {
    add_smooth_normals(*m);
    for (std::size_t t = 0; t < m->triangles.size(); t++)
      for (int c = 0; c < 3; c++) EXPECT_LT(angle_rad(m->normal(t, c), m->position(t, c)), 1e-9);
  }
}

// Both sides of a card on the same positions: what the sides add up to is nothing.
TEST(Mesh, SmoothNormalsThatCancelOutAreTheTrianglesOwn) {
  const Vec3d across = normalized(Vec3d{1, 2, -2}), up = normalized(Vec3d{2, 1, 2});
  Mesh card = without_uvs(grid_mesh(
      2, 2, [&](double u, double v) { return across * u + up * v; }, identity_uv));
  const std::size_t half = card.triangles.size();
  for (std::size_t t = 0; t < half; t++) {
    const auto [a, b, c] = card.triangles[t];
    card.triangles.push_back({a, c, b});
  }
  card = decimate(card, card.triangles.size());  // which gives it normals
  const Vec3d front = cross(across, up);
  for (std::size_t t = 0; t < 2 * half; t++) {
    const Vec3d expected = t < half ? front : -front;
    for (int c = 0; c < 3; c++) EXPECT_LT(angle_rad(card.normal(t, c), expected), 1e-12) << t;
    EXPECT_LT(angle_rad(normal_at(card, {std::uint32_t(t), {0.2, 0.3, 0.5}}), expected), 1e-12) << t;
  }
}

TEST(Mesh, NormalsOfWhatHasNoAreaAreUnitToo) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  add_smooth_normals(mesh);
  for (int c = 0; c < 3; c++) EXPECT_EQ(mesh.normal(0, c), (Vec3d{0, 0, 1}));
}

}  // namespace
}  // namespace burnish
