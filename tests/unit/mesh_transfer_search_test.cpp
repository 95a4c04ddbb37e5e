#include <gtest/gtest.h>

#include <cmath>

#include "expect_error.h"
#include "mesh_transfer_fixture.h"

namespace burnish {
namespace {

TEST(TransferSearch, DistancesAreSignedAndAlongTheNormal) {
  const double slope = 0.25;
  const Mesh tilted = grid_mesh(
      3, 3,
      [&](double u, double v) {
        return Vec3d{1.4 * u - 0.2, 1.4 * v - 0.2, slope * (1.4 * u - 0.6)};
      },
      identity_uv);
  TransferOptions options = at_size(16, 16);
  options.max_distance = 1;
  const TransferMaps maps = transfer_detail(square(0), without_uvs(tilted), options);
  for (int y = 0; y < 16; y++)
    for (int x = 0; x < 16; x++) {
      EXPECT_NEAR(*maps.displacement.at(x, y), slope * ((x + 0.5) / 16 - 0.4), 1e-6);
      EXPECT_LT(angle_rad(object_normal(maps, x, y), Vec3d{-slope, 0, 1}), 1e-6);
      EXPECT_EQ(*maps.coverage.at(x, y), kFound);
    }
  EXPECT_NEAR(maps.max_distance, slope * (31.5 / 32 - 0.4), 1e-6);  // at the last of the samples
}

TEST(TransferSearch, SurfacesThatTouchAreFound) {
  const Mesh same = grid_mesh(12, 9, unit_sphere, identity_uv);
  const TransferMaps maps = transfer_detail(same, without_uvs(same), at_size(64, 64));
  EXPECT_EQ(maps.missed_texels, 0u);
  EXPECT_LT(maps.max_distance, 1e-5);

  const Mesh layers = joined(joined(square(0.1), square(0)), square(-0.1));
  for (const float d : transfer_detail(square(0), layers, at_size(16, 16)).displacement.data) EXPECT_NEAR(d, 0, 1e-6);
}

// A wall thinner than the way to its near side: its far side, met first, faces the other way.
TEST(TransferSearch, TheFarSideOfAThinWallIsPassedOver) {
  for (const double near : {0.3, -0.2}) {
    const Mesh wall = joined(square(near), facing_down(square(near - 0.1)));
    TransferOptions options = at_size(8, 8);
    options.max_distance = 1;
    const TransferMaps maps = transfer_detail(square(0), wall, options);
    for (int i = 0; i < 64; i++) {
      EXPECT_EQ(maps.normals[i], (Vec3f{0, 0, 1}));
      EXPECT_NEAR(maps.displacement.data[i], near, 1e-6);
    }
  }
}

TEST(TransferSearch, TheNearerSideCounts) {
  const Mesh layers = joined(joined(square(0.3), square(-0.2)), square(0.9));
  TransferOptions options = at_size(4, 4);
  options.max_distance = 1;
  EXPECT_NEAR(transfer_detail(square(0), layers, options).displacement.data[5], -0.2, 1e-6);
  EXPECT_NEAR(transfer_detail(square(0.1), layers, options).displacement.data[5], 0.2, 1e-6);
  options.max_distance = 0.1, options.cage = 1;
  EXPECT_NEAR(transfer_detail(square(0), layers, options).displacement.data[5], 0.3, 1e-6);
  options.max_distance = 1, options.cage = 0.1;
  EXPECT_NEAR(transfer_detail(square(0.5), layers, options).displacement.data[5], -0.2, 1e-6);
}

// Beyond the rim of what the rays meet the nearest point serves, as far as max_distance reaches.
TEST(TransferSearch, WhatRaysMissTheNearestPointServes) {
  const Mesh half = grid_mesh(
      1, 1,
      [](double u, double v) {
        return Vec3d{0.5 * u, v, 0.01 * u};
      },
      identity_uv);
  TransferOptions options = at_size(32, 32);
  options.samples = 1, options.max_distance = 0.2;
  const TransferMaps maps = transfer_detail(square(0), without_uvs(half), options);
  std::size_t missed = 0;
  for (int x = 0; x < 32; x++) {
    const bool reached = (x + 0.5) / 32 <= 0.5 + std::sqrt(0.2 * 0.2 - 0.01 * 0.01);
    EXPECT_EQ(*maps.coverage.at(x, 16), reached ? kFound : kMissed) << x;
    EXPECT_EQ(object_normal(maps, x, 16).x == 0, !reached) << x;  // missed: the square's own
    if (x >= 16) {
      EXPECT_NEAR(*maps.displacement.at(x, 16), reached ? 0.01 : 0, 1e-6) << x;
    }
    missed += !reached;
  }
  EXPECT_EQ(maps.missed_texels, missed * 32);
  EXPECT_EQ(maps.covered_texels, 32u * 32);
}

TEST(TransferSearch, WhatFacesTheOtherWayServesNoOne) {
  // It stands upright, so that the normal which is kept is no default.
  const auto wall = [](double x) {
    return grid_mesh(
        1, 1,
        [x](double u, double v) {
          return Vec3d{x, u, v};
        },
        identity_uv);
  };
  TransferOptions options = at_size(16, 16);
  options.max_distance = 1;
  const Mesh other_way = facing_down(wall(0.01));
  EXPECT_ERROR(transfer_detail(wall(0), without_uvs(other_way), options), ErrorKind::kMalformed,
               "expected a surface within 1 of ");
  options.cage = 0.5;
  EXPECT_ERROR(transfer_detail(wall(0), without_uvs(other_way), options), ErrorKind::kMalformed,
               "expected a surface within 1 (outwards 0.5) of ");

  // A strip that does serve: the lowest four rows of texels, and no more by its nearest points.
  Mesh strip = wall(0.02);
  for (Vec3d& p : strip.positions) p.z *= 0.25;
  options.samples = 1, options.max_distance = options.cage = 0.03;
  const TransferMaps maps = transfer_detail(wall(0), without_uvs(joined(other_way, strip)), options);
  EXPECT_EQ(maps.missed_texels, 12u * 16);
  EXPECT_NEAR(maps.max_distance, 0.02, 1e-6);
  for (int i = 0; i < 256; i++) EXPECT_EQ(maps.coverage.data[i], i < 12 * 16 ? kMissed : kFound) << i;
  for (const Vec3f& n : maps.normals) EXPECT_EQ(n, (Vec3f{1, 0, 0}));
}

}  // namespace
}  // namespace burnish
