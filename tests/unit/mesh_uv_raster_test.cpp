#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../mesh_patterns.h"
#include "burnish/mesh/bake/uv_raster.h"
#include "expect_error.h"

namespace burnish {
namespace {

Mesh flat(int columns, int rows) {
  return grid_mesh(
      columns, rows,
      [](double u, double v) {
        return Vec3d{u, v, 0};
      },
      identity_uv);
}

Mesh triangles_in_map(const std::vector<Vec2d>& corners) {
  Mesh mesh;
  for (const Vec2d& uv : corners) {
    mesh.uvs.push_back(uv);
    mesh.positions.push_back({uv.x, uv.y, 0});
  }
  for (std::uint32_t i = 0; i < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  mesh.triangle_uvs = mesh.triangles;
  return mesh;
}

struct Cover {
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint8_t> several;
};

Cover cover(const Mesh& mesh, int width, int height) {
  const UvRaster raster(mesh, width, height);
  Cover out{std::vector<std::uint32_t>(std::size_t(width) * height),
            std::vector<std::uint8_t>(std::size_t(width) * height)};
  for (int y = 0; y < height; y++)
    raster.row(y, out.triangles.data() + std::size_t(y) * width, out.several.data() + std::size_t(y) * width);
  return out;
}

// Which of the mesh's triangles take each texel, each rasterised alone.
std::vector<std::vector<std::uint32_t>> takers(const Mesh& mesh, int width, int height) {
  std::vector<std::vector<std::uint32_t>> out(std::size_t(width) * height);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); t++) {
    Mesh alone = mesh;
    alone.triangles = {mesh.triangles[t]}, alone.triangle_uvs = {mesh.triangle_uvs[t]};
    const Cover c = cover(alone, width, height);
    for (std::size_t i = 0; i < out.size(); i++)
      if (c.triangles[i] != UvRaster::kNone) out[i].push_back(t);
  }
  return out;
}

// Corners at arbitrary places, and on texel centres and borders, where ties are; each triangle turned by chance.
TEST(UvRaster, ATriangulationTakesEveryCentreExactlyOnce) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; round++) {
    const int n = 2 + round % 4, width = 16, height = 24;
    Mesh mesh = flat(n, n);
    for (Vec2d& uv : mesh.uvs) {
      if (uv.x == 0 || uv.x == 1 || uv.y == 0 || uv.y == 1) continue;
      const double amount = 0.12 / n;  // so little that no triangle turns over
      uv.x += amount * (2 * (random() / 4294967296.0) - 1), uv.y += amount * (2 * (random() / 4294967296.0) - 1);
      if (round % 2) uv = {std::round(uv.x * 2 * width) / (2 * width), std::round(uv.y * 2 * height) / (2 * height)};
    }
    for (Corners& c : mesh.triangle_uvs)
      if (random() & 1) std::swap(c[0], c[1]);
    const auto taken = takers(mesh, width, height);
    for (std::size_t i = 0; i < taken.size(); i++)
      ASSERT_EQ(taken[i].size(), 1u) << "round " << round << ", column " << i % width << ", row " << i / width;
    const Cover all = cover(mesh, width, height);
    EXPECT_EQ(std::ranges::count(all.several, 1), 0) << "round " << round;
    EXPECT_EQ(std::ranges::count(all.triangles, UvRaster::kNone), 0) << "round " << round;
  }
}

// A fan round a texel's centre: the centre belongs to one of the triangles.
TEST(UvRaster, ACornerOnACentreIsTakenOnce) {
  const int w = 8;
  const Vec2d middle{4.5 / w, 4.5 / w};
  std::vector<Vec2d> corners;
  for (int i = 0; i < 8; i++) {
    const auto rim = [&](int k) {
      const double angle = k * kPi / 4;
      return middle + Vec2d{std::round(std::cos(angle)) * 2 / w, std::round(std::sin(angle)) * 2 / w};
    };
    corners.insert(corners.end(), {middle, rim(i), rim((i + 1) % 8)});
  }
  EXPECT_EQ(takers(triangles_in_map(corners), w, w)[3 * w + 4].size(), 1u);
}

TEST(UvRaster, TexelsAreWhereTheirPointsAre) {
  std::mt19937 random(3);
  const auto any = [&] { return random() / 4294967296.0; };
  for (int round = 0; round < 200; round++) {
    const int width = 1 + int(random() % 40), height = 1 + int(random() % 40);
    const Mesh mesh = triangles_in_map({{any(), any()}, {any(), any()}, {any(), any()}});
    const UvRaster raster(mesh, width, height);
    const Cover c = cover(mesh, width, height);
    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++) {
        const Vec2d centre{(x + 0.5) / width, 1 - (y + 0.5) / height};
        // By the definition: the least distance to an edge's line, in texels, negative outside.
        double inside = 1e9;
        const double turn = cross(mesh.uv(0, 1) - mesh.uv(0, 0), mesh.uv(0, 2) - mesh.uv(0, 0)) < 0 ? -1 : 1;
        for (int k = 0; k < 3; k++) {
          const Vec2d a{mesh.uv(0, k).x * width, mesh.uv(0, k).y * height},
              b{mesh.uv(0, (k + 1) % 3).x * width, mesh.uv(0, (k + 1) % 3).y * height},
              p{centre.x * width, centre.y * height};
          inside = std::min(inside, turn * cross(b - a, p - a) / std::hypot((b - a).x, (b - a).y));
        }
        const bool taken = c.triangles[std::size_t(y) * width + x] == 0;
        if (std::abs(inside) > 1e-3) {
          ASSERT_EQ(taken, inside > 0) << x << "," << y << " of " << width << "x" << height;
        }
        if (!taken) continue;
        const MeshPoint point = raster.point(0, x, y);
        EXPECT_NEAR(point.weight[0] + point.weight[1] + point.weight[2], 1, 1e-12);
        for (const double weight : point.weight) EXPECT_GE(weight, 0);
        EXPECT_NEAR(uv_at(mesh, point).x * width, centre.x * width, 3e-4);
        EXPECT_NEAR(uv_at(mesh, point).y * height, centre.y * height, 3e-4);
      }
  }
}

TEST(UvRaster, OfSeveralTheFirstTriangleCounts) {
  Mesh mesh = triangles_in_map({{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {1, 1}});
  const int w = 10;
  const Cover c = cover(mesh, w, w);
  const auto at = [&](double u, double v) { return std::size_t((1 - v) * w) * w + std::size_t(u * w); };
  EXPECT_EQ(c.triangles[at(0.15, 0.55)], 0u);
  EXPECT_EQ(c.triangles[at(0.85, 0.55)], 1u);
  EXPECT_EQ(c.triangles[at(0.55, 0.15)], 0u);
  EXPECT_EQ(c.triangles[at(0.55, 0.95)], UvRaster::kNone);
  EXPECT_EQ(c.several[at(0.55, 0.15)], 1);
  EXPECT_EQ(c.several[at(0.15, 0.55)], 0);
  EXPECT_EQ(c.several[at(0.85, 0.55)], 0);
}

// From a few triangles to so many that whole rows are taken twice and more, in maps of several bands of rows.
TEST(UvRaster, OfAnyNumberTheFirstCountsAndTheRestAreSeveral) {
  std::mt19937 random(5);
  const auto any = [&] { return random() / 4294967296.0; };
  for (const int count : {3, 12, 60, 400})
    for (const double size : {0.2, 1.0}) {
      std::vector<Vec2d> corners;
      for (int t = 0; t < count; t++) {
        const Vec2d at = Vec2d{any(), any()} * (1 - size);
        for (int c = 0; c < 3; c++) corners.push_back(at + Vec2d{any(), any()} * size);
      }
      const Mesh mesh = triangles_in_map(corners);
      const int width = 29, height = 101;
      const Cover c = cover(mesh, width, height);
      const auto taken = takers(mesh, width, height);
      for (std::size_t i = 0; i < taken.size(); i++) {
        ASSERT_EQ(c.triangles[i], taken[i].empty() ? UvRaster::kNone : taken[i][0]) << count << ' ' << size << ' ' << i;
        ASSERT_EQ(c.several[i], taken[i].size() > 1) << count << ' ' << size << ' ' << i;
      }
    }
}

TEST(UvRaster, WithoutAreaNothingIsCovered) {
  const Mesh mesh = triangles_in_map({{0, 0}, {0.5, 0.5}, {1, 1}, {0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}});
  for (const int w : {1, 7, 64}) EXPECT_EQ(std::ranges::count(cover(mesh, w, w).triangles, UvRaster::kNone), w * w);
}

TEST(UvRaster, SizesOutOfRange) {
  const Mesh mesh = flat(1, 1);
  EXPECT_ERROR(UvRaster(mesh, 0, 5), ErrorKind::kUsage, "got 0x5");
  EXPECT_ERROR(UvRaster(mesh, 5, UvRaster::kMostTexels + 1), ErrorKind::kUsage, "expected 1 to 262144");
  EXPECT_NE(cover(mesh, UvRaster::kMostTexels, 1).triangles.back(), UvRaster::kNone);
}

TEST(UvCharts, ShareAnEdgeInSpaceAndInTheMap) {
  const Mesh whole = flat(3, 2);
  EXPECT_EQ(uv_charts(whole), std::vector<std::uint32_t>(12, 0));

  Mesh cut = whole;  // a seam in the map
  for (std::size_t t = 6; t < 12; t++)
    for (std::uint32_t& uv : cut.triangle_uvs[t]) {
      cut.uvs.push_back({cut.uvs[uv].x, cut.uvs[uv].y + 1e-9});
      uv = std::uint32_t(cut.uvs.size() - 1);
    }
  EXPECT_EQ(uv_charts(cut), (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));

  Mesh apart = flat(2, 1);  // side by side in the map, apart in space
  apart.positions.insert(apart.positions.end(), {{0.5, 0, 9}, {0.5, 1, 9}});
  for (std::size_t t = 2; t < 4; t++)
    for (std::uint32_t& p : apart.triangles[t])
      if (apart.positions[p].x == 0.5) p = apart.positions[p].y == 0 ? 6 : 7;
  EXPECT_EQ(uv_charts(apart), (std::vector<std::uint32_t>{0, 0, 1, 1}));

  // The same values under indices of their own are the same edge; one corner is not enough.
  const Mesh loose = triangles_in_map({{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {-1, 0}, {0, -1}});
  EXPECT_EQ(uv_charts(loose), (std::vector<std::uint32_t>{0, 0, 1}));
}

}  // namespace
}  // namespace burnish
