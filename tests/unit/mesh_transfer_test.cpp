#include <gtest/gtest.h>

#include <cmath>

#include "burnish/mesh/bake/displaced_normals.h"
#include "burnish/mesh/bake/transfer.h"
#include "burnish/mesh/bake/uv_raster.h"
#include "burnish/mesh/tangent_frames.h"
#include "expect_error.h"
#include "mesh_transfer_fixture.h"
#include "on_threads.h"

namespace burnish {
namespace {

Mesh sphere(int columns, int rows) { return grid_mesh(columns, rows, unit_sphere, identity_uv); }

// f(place on the mesh, x, y) for each texel whose centre the mesh covers.
template <typename F>
void each_centre(const Mesh& mesh, int width, int height, const F& f) {
  const UvRaster raster(mesh, width, height);
  std::vector<std::uint32_t> triangles(width);
  std::vector<std::uint8_t> several(width);
  for (int y = 0; y < height; y++) {
    raster.row(y, triangles.data(), several.data());
    for (int x = 0; x < width; x++)
      if (triangles[x] != UvRaster::kNone) f(raster.point(triangles[x], x, y), x, y);
  }
}

// The true normal at a place near the unit sphere is its direction from the centre.
double rms_deg_from_sphere(const Mesh& coarse, const TransferOptions& options, const TransferMaps& maps) {
  const TangentFrames frames = options.space == NormalSpace::kTangent ? tangent_frames(coarse) : TangentFrames();
  double sum = 0;
  std::size_t count = 0;
  each_centre(coarse, maps.width, maps.height, [&](const MeshPoint& place, int x, int y) {
    Vec3d n = object_normal(maps, x, y);
    if (options.space == NormalSpace::kTangent) n = frame_at(coarse, frames, place).to_object(n);
    sum += std::pow(degrees(angle_rad(n, position_at(coarse, place))), 2), count++;
  });
  return std::sqrt(sum / double(count));
}

TEST(Transfer, ASphereInEitherSpaceAndAnyRays) {
  Mesh coarse = sphere(10, 10);  // 180 triangles
  add_smooth_normals(coarse);
  const Mesh fine = without_uvs(sphere(100, 100));
  for (const NormalSpace space : {NormalSpace::kObject, NormalSpace::kTangent})
    for (const RayDirection rays : {RayDirection::kSmooth, RayDirection::kHalfway})
      for (const int samples : {1, 3}) {
        TransferOptions options = at_size(128, 64);
        options.space = space, options.rays = rays, options.samples = samples;
        const TransferMaps maps = transfer_detail(coarse, fine, options);
        // Halfway rays meet the fine sphere beside the place's own direction.
        EXPECT_LT(rms_deg_from_sphere(coarse, options, maps), rays == RayDirection::kSmooth ? 0.1 : 0.5);
        EXPECT_EQ(maps.missed_texels, 0u);
        EXPECT_LT(maps.max_distance, 1 - std::cos(kPi / 10) * std::cos(kPi / 20) + 0.01);
      }
}

TEST(Transfer, SamplesAreAveragedInsideTheChart) {
  // Two charts meet in the map in the middle of a texel; what belongs to one stands at z = 0, to the other at z = 5.
  Mesh coarse = grid_mesh(
      2, 1,
      [](double u, double v) {
        return Vec3d{u, v, 0};
      },
      identity_uv);
  for (Vec2d& uv : coarse.uvs)
    if (uv.x == 0.5) uv.x = 2.6 / 4;
  coarse.positions.insert(coarse.positions.end(), {{0.5, 0, 5}, {0.5, 1, 5}});
  for (std::size_t t = 2; t < 4; t++)
    for (std::uint32_t& p : coarse.triangles[t]) {
      if (coarse.positions[p].x == 0.5) p = coarse.positions[p].y == 0 ? 6 : 7;
      if (coarse.positions[p].x == 1) coarse.positions[p].z = 5;
    }
  Mesh fine = joined(square(0.1), square(5.3));
  TransferOptions options = at_size(4, 4);
  options.max_distance = 1, options.samples = 4;
  const TransferMaps maps = transfer_detail(coarse, fine, options);
  for (int y = 0; y < 4; y++) {
    EXPECT_NEAR(*maps.displacement.at(1, y), 0.1, 1e-6);
    EXPECT_NEAR(*maps.displacement.at(2, y), 0.1, 1e-6) << "the first triangle's chart";
    EXPECT_NEAR(*maps.displacement.at(3, y), 0.3, 1e-6);
  }

  // A roof whose ridge runs through the middle of a texel, which holds the mean of both sides.
  const Mesh roof = grid_mesh(
      2, 1,
      [](double u, double v) {
        return Vec3d{u == 0.5 ? 2.5 / 4 : u, v, u == 0.5 ? 0.2 : 0.0};
      },
      identity_uv);
  Mesh hard = without_uvs(roof);
  for (std::size_t t = 0; t < 4; t++) {
    hard.normals.push_back(normalized(hard.perpendicular(t)));
    hard.triangle_normals.push_back({std::uint32_t(t), std::uint32_t(t), std::uint32_t(t)});
  }
  const TransferMaps ridge = transfer_detail(square(0), hard, options);
  const Vec3d left = normalized(Vec3d{-0.2 / 0.625, 0, 1}), right = normalized(Vec3d{0.2 / 0.375, 0, 1});
  EXPECT_LT(angle_rad(object_normal(ridge, 1, 1), left), 1e-6);
  EXPECT_LT(angle_rad(object_normal(ridge, 3, 1), right), 1e-6);
  EXPECT_LT(angle_rad(object_normal(ridge, 2, 1), left + right), 1e-6);
}

TEST(Transfer, HardEdgesLeaveNoGapsBetweenRays) {
  // A coarse sphere whose faces have normals of their own, and a fine one: along the faces' normals nothing of what
  // lies before the edges would be met.
  Mesh coarse = grid_mesh(8, 4, unit_sphere, identity_uv);
  for (std::size_t t = 0; t < coarse.triangles.size(); t++) {
    coarse.normals.push_back(normalized(coarse.perpendicular(t)));
    coarse.triangle_normals.push_back({std::uint32_t(t), std::uint32_t(t), std::uint32_t(t)});
  }
  TransferOptions options = at_size(64, 32);
  const TransferMaps maps = transfer_detail(coarse, without_uvs(sphere(64, 48)), options);
  EXPECT_LT(rms_deg_from_sphere(coarse, options, maps), 0.3);
}

// What the transfer measures, displaced over the same mesh again, has the normals that the transfer finds; the mesh is
// so fine that its facets hardly show.
TEST(Transfer, DisplacementAndNormalsAreOfOneSurface) {
  const Mesh coarse = grid_mesh(240, 120, torus, identity_uv);
  const Mesh fine = without_uvs(grid_mesh(
      400, 200,
      [](double u, double v) {
        const double turn = 2 * kPi * u, r = 0.4 + 0.015 * std::sin(12 * kPi * u) * std::cos(10 * kPi * v);
        const double around = 2 * kPi * v, ring = 1 + r * std::cos(around);
        return Vec3d{ring * std::sin(turn), r * std::sin(around), ring * std::cos(turn)};
      },
      identity_uv));
  const TransferMaps maps = transfer_detail(coarse, fine, at_size(512, 256));
  HeightMapOptions options;
  options.wrap_u = options.wrap_v = Wrap::kRepeat;
  options.neighbors = 8;
  const DisplacedNormals again = displaced_normals(coarse, {"d.exr", maps.displacement, {}, false}, options);
  double sum = 0;
  for (std::size_t i = 0; i < maps.normals.size(); i++)
    sum += std::pow(degrees(angle_rad(Vec3d(maps.normals[i]), Vec3d(again.normals[i]))), 2);
  EXPECT_GT(again.mean_tilt_deg, 5) << "there is something to find";
  EXPECT_LT(std::sqrt(sum / double(maps.normals.size())), 0.6);
}

TEST(Transfer, GuttersHoldTheNearestTexel) {
  Mesh coarse = square(0);
  for (Vec2d& uv : coarse.uvs) uv = {0.25 + 0.5 * uv.x, 0.25 + 0.5 * uv.y};
  const Mesh tilted = grid_mesh(
      1, 1,
      [](double u, double v) {
        return Vec3d{u, v, 0.1 + 0.1 * u};
      },
      identity_uv);
  TransferOptions options = at_size(16, 16);
  options.max_distance = 1;
  options.padding = 2;
  const TransferMaps maps = transfer_detail(coarse, without_uvs(tilted), options);
  EXPECT_EQ(maps.covered_texels, 64u);
  for (int x = 0; x < 16; x++) {
    const bool covered = x >= 4 && x < 12, gutter = !covered && x >= 2 && x < 14;
    EXPECT_EQ(*maps.coverage.at(x, 8), covered ? kFound : kUncovered);
    const int from = std::clamp(x, 4, 11);
    EXPECT_EQ(*maps.displacement.at(x, 8), covered || gutter ? *maps.displacement.at(from, 8) : 0);
    EXPECT_EQ(object_normal(maps, x, 8), covered || gutter ? object_normal(maps, from, 8) : (Vec3d{0, 0, 1}));
  }
}

TEST(Transfer, OverlapsAreCounted) {
  Mesh coarse = square(0, 2);  // four quads
  for (std::size_t t = 0; t < 2; t++) coarse.triangle_uvs[t] = coarse.triangle_uvs[t + 2];
  TransferOptions options = at_size(16, 16);
  const TransferMaps maps = transfer_detail(coarse, without_uvs(square(0)), options);
  EXPECT_EQ(maps.overlapped_texels, 64u);
  EXPECT_EQ(maps.covered_texels, 3u * 64);
}

TEST(Transfer, TheSameOnAnyNumberOfThreads) {
  TransferOptions options = at_size(96, 96);
  options.padding = 8;
  const Mesh fine = without_uvs(grid_mesh(60, 30, torus, identity_uv)), coarse = grid_mesh(14, 7, torus, identity_uv);
  const auto transfer = [&] { return transfer_detail(coarse, fine, options); };
  const TransferMaps alone = on_threads(1, transfer), together = on_threads(4, transfer);
  EXPECT_EQ(alone.normals, together.normals);
  EXPECT_EQ(alone.displacement.data, together.displacement.data);
  EXPECT_EQ(alone.coverage.data, together.coverage.data);
  EXPECT_EQ(alone.max_distance, together.max_distance);
  EXPECT_EQ(alone.missed_texels, 0u);
}

TEST(Transfer, ErrorsNameWhatIsWrong) {
  const Mesh fine = without_uvs(square(0));
  EXPECT_ERROR(transfer_detail(without_uvs(square(0)), fine, {}), ErrorKind::kMalformed, "burnish-simplify --atlas");
  Mesh outside = square(0);
  outside.uvs[1].x = 1.25;
  EXPECT_ERROR(transfer_detail(outside, fine, {}), ErrorKind::kMalformed, "in [0,1], got (1.25");
  Mesh flat = square(0);
  for (Vec2d& uv : flat.uvs) uv.y = 0.5;
  EXPECT_ERROR(transfer_detail(flat, fine, at_size(8, 8)), ErrorKind::kMalformed, "none that covers a texel of 8x8");
  const auto with = [](auto change) {
    TransferOptions options = at_size(8, 8);
    change(options);
    return options;
  };
  const Mesh coarse = square(0);
  using O = TransferOptions;
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.width = 0; })), ErrorKind::kUsage,
               "size: expected 1 to");
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.height = 200000; })), ErrorKind::kUsage, "131072, got");
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.samples = 17; })), ErrorKind::kUsage, "samples");
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.padding = -1; })), ErrorKind::kUsage, "padding");
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.max_distance = -1; })), ErrorKind::kUsage,
               "max-distance");
  EXPECT_ERROR(transfer_detail(coarse, fine, with([](O& o) { o.cage = NAN; })), ErrorKind::kUsage, "cage");
}

}  // namespace
}  // namespace burnish
