#include <gtest/gtest.h>

#include <set>

#include "burnish/mesh/files/polygon.h"

namespace burnish {
namespace {

using Outline = std::vector<Vec3d>;

double area(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return cross(b - a, c - a).z / 2; }

// Every triangle turns as the outline does, their areas sum to its own, and each of its edges is an edge of one.
void expect_tiled(const Outline& p) {
  double whole = 0, sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); i++) whole += area(p[0], p[i], p[i + 1]);
  const std::vector<Corners> triangles = triangulate(p);
  EXPECT_EQ(triangles.size(), p.size() - 2);
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (const Corners& t : triangles) {
    EXPECT_GT(area(p[t[0]], p[t[1]], p[t[2]]), 0);
    sum += area(p[t[0]], p[t[1]], p[t[2]]);
    for (int c = 0; c < 3; c++) EXPECT_TRUE(edges.insert({t[c], t[(c + 1) % 3]}).second);
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
  for (std::size_t i = 0; i < p.size(); i++) EXPECT_TRUE(edges.count({i, (i + 1) % p.size()})) << i;
}

TEST(Polygon, AConvexOutlineBecomesTheFanFromItsFirstCorner) {
  EXPECT_EQ(triangulate(Outline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
            (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
  Outline circle;
  for (int i = 0; i < 100; i++) circle.push_back({std::cos(i * kPi / 50), std::sin(i * kPi / 50), 0});
  const std::vector<Corners> fan = triangulate(circle);
  for (std::uint32_t i = 0; i < 98; i++) EXPECT_EQ(fan[i], (Corners{0, i + 1, i + 2}));
  expect_tiled(circle);
}

TEST(Polygon, OthersAreTiledWithoutOverlap) {
  expect_tiled({{0, 0, 0}, {2, -1, 0}, {0, 2, 0}, {-2, -1, 0}});  // reflex at the first corner
  expect_tiled({{2, -1, 0}, {0, 2, 0}, {-2, -1, 0}, {0, 0, 0}});  // and at the last
  expect_tiled({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {3, 0.5, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}});
  expect_tiled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}});  // corners amid its edges
  // A square with a square hole, joined by a bridge that the outline takes both ways.
  expect_tiled(
      {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}, {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}});
  Outline spiral;
  for (int side : {1, -1})
    for (int i = 0; i < 60; i++) {
      const double a = (side > 0 ? i : 59 - i) * 0.3, r = 1 + a + 0.3 * side;
      spiral.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
  expect_tiled(spiral);
}

TEST(Polygon, OneThatCrossesItselfBecomesAsManyTriangles) {
  EXPECT_EQ(triangulate(Outline{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(triangulate(Outline{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, -1, 0}, {2, 1, 0}}).size(), 3u);
  EXPECT_EQ(triangulate(Outline(7, {1, 2, 3})).size(), 5u);
}

}  // namespace
}  // namespace burnish
