#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "../mesh_patterns.h"
#include "burnish/mesh/atlas/atlas.h"
#include "burnish/mesh/atlas/chart_packing.h"
#include "burnish/mesh/atlas/chart_tree.h"
#include "burnish/mesh/atlas/flat_chart.h"
#include "burnish/mesh/simplify/decimate.h"
#include "expect_error.h"

namespace burnish {
namespace {

Mesh blob(std::size_t faces) { return decimate(without_uvs(named_mesh("torus", 48)), faces); }

// A staircase that winds about the z axis: seen from above, its turns lie over each other.
Mesh spiral() {
  return without_uvs(grid_mesh(
      120, 4,
      [](double u, double v) {
        const double a = 6 * kPi * u, r = 0.5 + 0.5 * v;
        return Vec3d{r * std::cos(a), r * std::sin(a), 0.2 * u};
      },
      identity_uv));
}

// Triangles that touch nothing.
Mesh confetti(int count) {
  Mesh mesh;
  mesh.name = "confetti.obj";
  for (std::uint32_t i = 0; i < std::uint32_t(count); i++) {
    const Vec3d at{double(i), 0.1 * i, 0};
    mesh.positions.insert(mesh.positions.end(), {at, at + Vec3d{0.9, 0, 0.1}, at + Vec3d{0, 0.4 + 0.01 * i, 0.2}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// Which chart each texel's centre lies in, by an independent rasteriser; two triangles on one texel are a failure.
struct Texels {
  Texels(const Mesh& mesh, int side) : size(side), chart(std::size_t(side) * side, -1) {
    std::vector<std::uint32_t> group(mesh.uvs.size());
    std::iota(group.begin(), group.end(), 0u);
    const auto root = [&](std::uint32_t i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    for (const Corners& t : mesh.triangle_uvs) group[root(t[1])] = root(t[0]), group[root(t[2])] = root(t[0]);
    std::set<std::uint32_t> roots;
    for (std::size_t t = 0; t < mesh.triangle_uvs.size(); t++) {
      roots.insert(root(mesh.triangle_uvs[t][0]));
      const Vec2d a = mesh.uv(t, 0) * size, b = mesh.uv(t, 1) * size, c = mesh.uv(t, 2) * size;
      for (int y = int(std::min({a.y, b.y, c.y})); y <= int(std::max({a.y, b.y, c.y})); y++)
        for (int x = int(std::min({a.x, b.x, c.x})); x <= int(std::max({a.x, b.x, c.x})); x++) {
          const Vec2d p{x + 0.5, y + 0.5};
          if (!(cross(b - a, p - a) > 0 && cross(c - b, p - b) > 0 && cross(a - c, p - c) > 0)) continue;
          int& here = chart[std::size_t(y) * size + x];
          if (here >= 0) overlaps++;
          else covered++;
          here = int(root(mesh.triangle_uvs[t][0]));
        }
    }
    charts = roots.size();
  }
  // Texels of one chart within kGutter of those of another, or of the border.
  int crowded() const {
    int count = 0;
    for (int y = 0; y < size; y++)
      for (int x = 0; x < size; x++) {
        const int here = chart[std::size_t(y) * size + x];
        for (int j = y - kGutter; here >= 0 && j <= y + kGutter; j++)
          for (int i = x - kGutter; i <= x + kGutter; i++) {
            const bool inside = i >= 0 && j >= 0 && i < size && j < size;
            const int there = inside ? chart[std::size_t(j) * size + i] : -2;
            count += there != -1 && there != here;
          }
      }
    return count;
  }

  int size;
  std::vector<int> chart;
  std::size_t covered = 0, overlaps = 0, charts = 0;
};

void expect_sound(const Mesh& mesh, int size, const AtlasStats& stats) {
  ASSERT_EQ(mesh.triangle_uvs.size(), mesh.triangles.size());
  for (const Vec2d& uv : mesh.uvs) {
    ASSERT_GT(std::min(uv.x, uv.y), 0);
    ASSERT_LT(std::max(uv.x, uv.y), 1);
  }
  double surface = 0, texture = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    surface += length(mesh.perpendicular(t));
    texture += cross(mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0));
  }
  EXPECT_NEAR(stats.covered, texture / 2, 1e-9);
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    const double density = cross(mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0)) /
                           length(mesh.perpendicular(t)) * surface / texture;
    EXPECT_GT(density, 1 / (kMostStretch * kMostStretch)) << t;
    EXPECT_LT(density, kMostStretch * kMostStretch) << t;
  }
  const Texels texels(mesh, size);
  EXPECT_EQ(texels.overlaps, 0u);
  EXPECT_EQ(texels.crowded(), 0);
  EXPECT_EQ(texels.charts, stats.charts);
}

TEST(Atlas, HasNoOverlapsGuttersAndOneDensity) {
  const std::vector<Mesh> meshes{
      blob(250),  without_uvs(named_mesh("sphere", 12)), without_uvs(named_mesh("sheet", 20)), spiral(), confetti(40),
      confetti(1)};
  for (const Mesh& plain : meshes)
    for (const int size : {1024, 601, 250}) {
      SCOPED_TRACE(::testing::Message() << plain.name << ' ' << plain.triangles.size() << " triangles at " << size);
      Mesh mesh = plain;
      const AtlasStats stats = add_atlas(mesh, size);
      expect_sound(mesh, size, stats);
      EXPECT_EQ(mesh.positions, plain.positions);
      EXPECT_EQ(mesh.triangles, plain.triangles);
    }
}

TEST(Atlas, FillsMostOfTheSquare) {
  for (const std::size_t faces : {250, 400}) {
    Mesh mesh = blob(faces);
    const AtlasStats stats = add_atlas(mesh, 1024);
    EXPECT_GT(stats.covered, 0.6) << faces;
    EXPECT_NEAR(double(Texels(mesh, 1024).covered) / (1024 * 1024), stats.covered, 0.002) << faces;
    EXPECT_LT(stats.charts, 40u) << faces;
  }
}

TEST(Atlas, OfManyTrianglesIsAsSound) {
  Mesh mesh = without_uvs(named_mesh("torus", 71));
  ASSERT_GT(mesh.triangles.size(), 20000u);
  const AtlasStats stats = add_atlas(mesh, 1024);
  expect_sound(mesh, 1024, stats);
  EXPECT_GT(stats.covered, 0.5);
}

TEST(Atlas, IsTheSameEachTime) {
  Mesh a = blob(250), b = a;
  add_atlas(a, 512);
  add_atlas(b, 512);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.triangle_uvs, b.triangle_uvs);
}

TEST(Atlas, RefusesTooFewTexels) {
  Mesh mesh = confetti(40);
  EXPECT_ERROR(add_atlas(mesh, 16), ErrorKind::kMalformed,
               "'confetti.obj': its 40 charts do not fit into an atlas of 16x16 texels");
  EXPECT_FALSE(mesh.has_uvs());
}

TEST(ChartTree, PartsMakeUpTheWholeAndFaceOneWay) {
  const Mesh mesh = blob(300);
  const ChartTree tree(mesh);
  std::vector<int> uses(mesh.triangles.size());
  for (const std::uint32_t root : tree.roots()) {
    Vec3d sum;
    double area = 0;
    for (const std::uint32_t t : tree.triangles(root)) {
      uses[t]++;
      sum += mesh.perpendicular(t), area += length(mesh.perpendicular(t));
    }
    EXPECT_GE(length(sum), 0.85 * area - 1e-12);
    std::vector<std::uint32_t> open{root};
    while (!open.empty()) {
      const std::uint32_t piece = open.back();
      open.pop_back();
      if (tree.is_triangle(piece)) continue;
      const auto [one, two] = tree.parts(piece);
      std::vector<std::uint32_t> both = tree.triangles(one);
      for (const std::uint32_t t : tree.triangles(two)) both.push_back(t);
      std::ranges::sort(both);
      EXPECT_EQ(both, tree.triangles(piece));
      open.push_back(one), open.push_back(two);
    }
  }
  for (const int n : uses) EXPECT_EQ(n, 1);
}

TEST(ChartTree, DoesNotJoinAcrossCrowdedEdgesOrOppositeNeighbours) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0.9, 0, 0.1}};
  mesh.triangles = {{0, 2, 1}, {1, 3, 0}};
  EXPECT_EQ(ChartTree(mesh).roots().size(), 1u);
  mesh.triangles = {{0, 2, 1}, {0, 3, 1}};  // one is seen from behind
  EXPECT_EQ(ChartTree(mesh).roots().size(), 2u);
  mesh.triangles = {{0, 2, 1}, {1, 3, 0}, {0, 4, 1}};
  EXPECT_EQ(ChartTree(mesh).roots().size(), 3u);
}

std::vector<std::uint32_t> all_of(const Mesh& mesh) {
  std::vector<std::uint32_t> out(mesh.triangles.size());
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

TEST(FlatChart, OfWhatCanBeUnrolledIsCongruent) {
  // A quarter of a cylinder, bent by 90°.
  const Mesh bent = without_uvs(grid_mesh(
      12, 5,
      [](double u, double v) {
        return Vec3d{std::sin(kPi / 2 * u), v, std::cos(kPi / 2 * u)};
      },
      identity_uv));
  const auto chart = flatten(bent, all_of(bent));
  ASSERT_TRUE(chart);
  for (std::size_t t = 0; t < chart->triangles.size(); t++)
    for (int c = 0; c < 3; c++) {
      const Vec2d edge = chart->points[chart->corners[t][(c + 1) % 3]] - chart->points[chart->corners[t][c]];
      const Vec3d own = bent.position(chart->triangles[t], (c + 1) % 3) - bent.position(chart->triangles[t], c);
      EXPECT_NEAR(std::sqrt(edge.x * edge.x + edge.y * edge.y), length(own), 1e-3 * length(own));
    }
  EXPECT_EQ(chart->borders.size(), 2u * (12 + 5));
}

TEST(FlatChart, RefusesWhatLiesOverItselfOrFacesBothWays) {
  const Mesh stairs = spiral();
  EXPECT_FALSE(flatten(stairs, all_of(stairs)));
  const Mesh ball = without_uvs(named_mesh("sphere", 8));
  EXPECT_FALSE(flatten(ball, all_of(ball)));
}

// A hexagon round an edge that has a corner in its middle on one side only: a needle fills the gap. With two of the
// hexagon's corners raised, what is above the edge is laid out over what is below it.
TEST(FlatChart, RefusesANeedleThatTurnsOver) {
  for (const double raised : {0.0, 1.0}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
    for (int i = 0; i < 6; i++)
      mesh.positions.push_back({2 * std::cos(i * kPi / 3), 2 * std::sin(i * kPi / 3), i == 3 || i == 5 ? raised : 0});
    mesh.triangles = {{1, 2, 0}, {0, 2, 4}, {0, 4, 5}, {0, 5, 1}, {2, 3, 4},
                      {1, 5, 6}, {1, 6, 7}, {1, 7, 8}, {1, 8, 2}, {2, 8, 3}};
    EXPECT_EQ(flatten(mesh, all_of(mesh)).has_value(), raised == 0) << raised;
  }
}

TEST(FlatChart, OfASphereCapKeepsAreasNearly) {
  const Mesh cap = without_uvs(grid_mesh(
      24, 8,
      [](double u, double v) {
        const Vec2d c = circle(u);
        const double a = kPi / 4 * v;
        return Vec3d{std::sin(a) * c.x, std::sin(a) * c.y, std::cos(a)};
      },
      identity_uv));
  const auto chart = flatten(cap, all_of(cap));
  ASSERT_TRUE(chart);
  for (std::size_t t = 0; t < chart->triangles.size(); t++) {
    const auto& [a, b, c] = chart->corners[t];
    const double area2 = cross(chart->points[b] - chart->points[a], chart->points[c] - chart->points[a]);
    EXPECT_NEAR(area2 / length(cap.perpendicular(chart->triangles[t])), 1, 0.2);
  }
}

}  // namespace
}  // namespace burnish
