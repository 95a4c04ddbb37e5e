#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/mesh/bake/uv_raster.h"
#include "expect_error.h"
#include "mesh_displaced_normals_fixture.h"
#include "on_threads.h"

namespace burnish {
namespace {

// A map that is sheared and scaled differently along its sides: the definition, with the gradient from the sheet's
// plane.
TEST(DisplacedNormals, InASkewedMap) {
  const double height = 0.25;
  const HeightField field = field_of(64, 64, [](double u, double v) { return 2 * u + 3 * v; });
  const Mesh mesh = grid_mesh(
      2, 2,
      [](double u, double v) {
        return Vec3d{u, v, 0};
      },
      turned_uv);
  // turned_uv: U = 0.3 + 0.4x − 0.2y, V = 0.2 + 0.2x + 0.5y, so z = height·(2U + 3V) has these slopes.
  const Vec3d expected = normalized(Vec3d{-height * (2 * 0.4 + 3 * 0.2), -height * (2 * -0.2 + 3 * 0.5), 1});
  const DisplacedNormals map = displaced_normals(mesh, field, with_height(height));
  std::size_t covered = 0, other = 0;
  for (std::size_t i = 0; i < map.normals.size(); i++) {
    covered += map.covered.data[i];
    other += map.covered.data[i] && degrees(angle_rad(Vec3d(map.normals[i]), expected)) > 2e-3;
  }
  EXPECT_EQ(covered, map.covered_texels);
  EXPECT_EQ(other, map.degenerate_texels) << "in the corners of the chart";
  EXPECT_LE(other, 4u);
  EXPECT_NEAR(double(covered) / (64 * 64), 0.4 * 0.5 + 0.2 * 0.2, 0.005);
  EXPECT_NEAR(map.max_slope_deg, degrees(angle_rad(expected, {0, 0, 1})), 2e-3);
}

// The unit sphere, displaced by waves: its normals from differences of the surface itself.
double rms_deg_on_sphere(int rows, int width) {
  const double amount = 0.1;
  const auto wave = [&](double u, double v) {
    const double s = std::sin(kPi * v);
    return std::sin(12 * kPi * u) * s * s * std::sin(8 * kPi * v);
  };
  const HeightField field = field_of(width, width / 2, wave);
  HeightMapOptions options = with_height(amount);
  options.wrap_u = Wrap::kRepeat;
  const DisplacedNormals map = displaced_normals(grid_mesh(2 * rows, rows, unit_sphere, identity_uv), field, options);
  const auto surface = [&](double u, double v) {
    const Vec3d radial{std::sin(kPi * v) * std::sin(2 * kPi * u), -std::cos(kPi * v),
                       std::sin(kPi * v) * std::cos(2 * kPi * u)};
    return radial * (1 + amount * wave(u, v));
  };
  double sum = 0;
  int count = 0;
  for (int y = map.height / 10; y < map.height * 9 / 10; y++)
    for (int x = 0; x < map.width; x++) {
      const double u = (x + 0.5) / map.width, v = 1 - (y + 0.5) / map.height, e = 1e-5;
      const Vec3d expected = cross(surface(u + e, v) - surface(u - e, v), surface(u, v + e) - surface(u, v - e));
      sum += std::pow(degrees(angle_rad(expected, normal_of(map, x, y))), 2), count++;
    }
  return std::sqrt(sum / count);
}

TEST(DisplacedNormals, OnASphereTheyConvergeToTheTrueOnes) {
  const double coarse = rms_deg_on_sphere(16, 256), fine = rms_deg_on_sphere(32, 512),
               finer = rms_deg_on_sphere(64, 1024);
  EXPECT_LT(coarse, 1.2);  // the steepest slope is 39°
  EXPECT_LT(fine, 0.55 * coarse);
  EXPECT_LT(finer, 0.55 * fine);
}

TEST(DisplacedNormals, ABentSheetCountsByItsHeight) {
  const double radius = 1 / kPi, slope = 0.5;
  // Turns per unit of u: the ramp rises by `slope` per unit of length at the tube's own radius.
  const HeightField ramp = field_of(256, 8, [&](double u, double) { return 2 * slope * (u - 0.5); });
  for (const double offset : {0.0, 0.2, -0.1}) {
    HeightMapOptions options;
    options.mid_level = -offset;
    const DisplacedNormals map = displaced_normals(tube(512), ramp, options);
    for (const int x : {64, 128, 200}) {
      const double u = (x + 0.5) / 256, h = 2 * slope * (u - 0.5) + offset;
      const double turn = 2 * kPi * u;
      const Vec3d out{std::cos(turn), std::sin(turn), 0}, round{-std::sin(turn), std::cos(turn), 0};
      const Vec3d expected = out - round * (slope / (1 + h / radius));
      EXPECT_LT(degrees(angle_rad(expected, normal_of(map, x, 3))), 0.05) << "column " << x << ", offset " << offset;
    }
  }
}

TEST(DisplacedNormals, AConstantHeightMovesNoNormal) {
  Mesh mesh = grid_mesh(12, 9, torus, identity_uv);
  add_smooth_normals(mesh);
  for (const double h : {0.0, 0.1, 25.0, -3.0}) {
    const DisplacedNormals map =
        displaced_normals(mesh, field_of(48, 48, [](double, double) { return 1.0; }), with_height(h));
    const UvRaster raster(mesh, 48, 48);
    std::vector<std::uint32_t> triangles(48);
    std::vector<std::uint8_t> several(48);
    for (int y = 0; y < 48; y++) {
      raster.row(y, triangles.data(), several.data());
      for (int x = 0; x < 48; x++)
        EXPECT_LT(angle_rad(normal_of(map, x, y), normal_at(mesh, raster.point(triangles[x], x, y))), 1e-6);
    }
    EXPECT_LT(map.max_slope_deg, 1e-6);
  }
}

TEST(DisplacedNormals, AFitKeepsToItsChart) {
  // Two sheets side by side in the map and apart in space; heights jump between them.
  Mesh mesh = grid_mesh(
      2, 1,
      [](double u, double v) {
        return Vec3d{u, v, 0};
      },
      identity_uv);
  mesh.positions.insert(mesh.positions.end(), {{0.5, 0, 9}, {0.5, 1, 9}});
  for (std::size_t t = 2; t < 4; t++)
    for (std::uint32_t& p : mesh.triangles[t])
      if (mesh.positions[p].x == 0.5) p = mesh.positions[p].y == 0 ? 6 : 7;
  const HeightField field = field_of(16, 16, [](double u, double) { return u < 0.5 ? 0 : 100; });
  for (const int neighbors : {4, 24}) {
    HeightMapOptions options;
    options.neighbors = neighbors;
    EXPECT_LT(displaced_normals(mesh, field, options).max_slope_deg, 1e-6);
  }
  EXPECT_GT(displaced_normals(sheet(kA, kB), field, {}).max_slope_deg, 80) << "one chart: the jump is a cliff";
}

TEST(DisplacedNormals, WhatIsMaskedOrAloneHoldsTheSmoothNormal) {
  HeightField field = field_of(16, 16, waves);
  field.mask = ByteImage(16, 16);
  for (std::size_t i = 0; i < field.mask.data.size(); i++) field.mask.data[i] = i / 16 < 8;
  field.mask.data[12 * 16 + 5] = 1;  // alone among masked ones
  *field.heights.at(3, 10) = std::numeric_limits<float>::quiet_NaN();
  const DisplacedNormals map = displaced_normals(sheet(kA, kB), field, {});
  const Vec3d flat = normalized(cross(kA, kB));
  for (const int y : {8, 10, 12, 15}) EXPECT_LT(angle_rad(normal_of(map, y == 12 ? 5 : 3, y), flat), 1e-6);
  EXPECT_GT(angle_rad(normal_of(map, 3, 3), flat), 0.01);
  EXPECT_EQ(map.degenerate_texels, 1u);
  EXPECT_EQ(map.covered_texels, 256u);
}

// At the middle of the map the corners' normals add up to nothing.
TEST(DisplacedNormals, WhereCornerNormalsCancelOutTheTrianglesOwnCounts) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = mesh.triangle_uvs = {{0, 1, 2}, {0, 2, 3}};
  mesh.normals = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}};
  mesh.triangle_normals = {{0, 1, 2}, {0, 2, 1}};
  const DisplacedNormals map = displaced_normals(mesh, field_of(3, 3, [](double, double) { return 0.5; }), {});
  EXPECT_EQ(normal_of(map, 1, 1), (Vec3d{0, 0, 1}));
}

TEST(DisplacedNormals, TheSameOnAnyNumberOfThreads) {
  const HeightField field = field_of(100, 60, waves);
  const Mesh mesh = grid_mesh(20, 10, torus, identity_uv);
  const auto displace = [&] { return displaced_normals(mesh, field, {}); };
  const DisplacedNormals alone = on_threads(1, displace), together = on_threads(4, displace);
  EXPECT_EQ(alone.normals, together.normals);
  EXPECT_EQ(alone.mean_tilt_deg, together.mean_tilt_deg);
}

TEST(DisplacedNormals, ErrorsNameWhatIsWrong) {
  HeightField field = field_of(8, 8, waves);
  EXPECT_ERROR(displaced_normals(without_uvs(sheet(kA, kB)), field, {}), ErrorKind::kMalformed, "texture coordinates");
  const auto beyond = [](double u, double v) { return Vec2d{1.5 * u, v}; };
  EXPECT_ERROR(displaced_normals(sheet(kA, kB, beyond), field, {}), ErrorKind::kMalformed, "in [0,1]");
  const auto line = [](double u, double) { return Vec2d{u, 0.5}; };
  EXPECT_ERROR(displaced_normals(sheet(kA, kB, line), field, {}), ErrorKind::kMalformed,
               "none that covers a texel of 8x8");
  EXPECT_ERROR(displaced_normals(sheet(kA, kB), field, with_height(INFINITY)), ErrorKind::kUsage, "height");
  for (const double height : {1e160, 1e300, -1e308})
    EXPECT_ERROR(displaced_normals(sheet(kA, kB), field, with_height(height)), ErrorKind::kMalformed,
                 "'h.exr': slopes are too steep");
  HeightMapOptions options;
  options.neighbors = 5;
  EXPECT_ERROR(displaced_normals(sheet(kA, kB), field, options), ErrorKind::kUsage, "neighbors");
  *field.heights.at(5, 6) = *field.heights.at(2, 7) = std::numeric_limits<float>::infinity();
  EXPECT_ERROR(displaced_normals(sheet(kA, kB), field, {}), ErrorKind::kMalformed,
               "'h.exr': expected finite heights, got NaN or infinity at column 5, row 6");
  const auto left = [](double u, double v) { return Vec2d{0.25 * u, v}; };  // neither is covered
  EXPECT_EQ(displaced_normals(sheet(kA, kB, left), field, {}).covered_texels, 16u);
}

}  // namespace
}  // namespace burnish
