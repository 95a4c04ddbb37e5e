#include <gtest/gtest.h>

#include "burnish/material/mips/lobe_maps.h"
#include "burnish/material/mips/material_mips.h"
#include "expect_error.h"
#include "material_lobe_fixture.h"

namespace burnish {
namespace {

using enum MaterialModel;

MaterialTextures one(MaterialModel model, const Lobe& o) {
  return textures_of(model, 1, 1, [&](int, int) { return o; });
}

void expect_texel(const Image& map, Vec3d wanted) {
  const double values[] = {wanted.x, wanted.y, wanted.z};
  for (int c = 0; c < map.channels; c++) EXPECT_NEAR(map.data[c], values[c], 1e-5) << "channel " << c;
}

TEST(LobeMaps, EveryLevelOfAlphaAndDirection) {
  const Lobe o = lobe_of(kWard, frame_of(0.1, 0.2, 0.5), 0.2, 0.4, 0.7);
  MaterialTextures m = textures_of(kWard, 4, 2, [&](int, int) { return o; });
  build_material_mips(m, 0, "m");
  const std::vector<Image> alphas = alpha_maps(m), directions = direction_maps(m);
  ASSERT_EQ(alphas.size(), 3u);
  ASSERT_EQ(directions.size(), 3u);
  EXPECT_EQ(alphas[1].width, 2);
  EXPECT_EQ(directions[0].height, 2);
  expect_texel(alphas[0], {0.2, 0.4, 0.7});
  expect_texel(directions[0], o.frame.t);
}

// α_b = r², α_t = α_b + (1 − α_b) s²; the axis lies along the wider.
TEST(LobeMaps, KhrComesBackThroughItsDefinition) {
  for (const auto& [x, y] : {std::pair{0.1, 0.6}, {0.6, 0.1}, {0.3, 0.3}, {1.0, 0.2}, {1.0, 1.0}}) {
    const Lobe o = lobe_of(kWard, frame_of(0, 0, 0.4), x, y);
    const KhrMaps maps = khr_maps(one(kWard, o));
    EXPECT_EQ(maps.wider_texels, 0u);
    const std::vector<float>& khr = maps.anisotropy[0].data;
    const double narrow = std::pow(maps.roughness[0].data[0], 2), wide = narrow + (1 - narrow) * khr[2] * khr[2];
    EXPECT_NEAR(narrow, std::min(x, y), 1e-5);
    EXPECT_NEAR(wide, std::max(x, y), 1e-5);
    const Vec3d along{2.0 * khr[0] - 1, 2.0 * khr[1] - 1, 0};
    EXPECT_NEAR(length(along - (x >= y ? o.frame.t : o.frame.b)), 0, 1e-5) << x << ", " << y;
  }
}

TEST(LobeMaps, KhrOfBlinnPhongIsAsWideAsItsLobe) {
  Lobe o = lobe_of(kBlinnPhong, frame_of(0, 0), 1, 1);
  o.exponent = 4, o.alpha_x = 1, o.alpha_y = 0.5;  // √(2/(N+4)) = ½
  const KhrMaps maps = khr_maps(one(kBlinnPhong, o));
  EXPECT_NEAR(maps.roughness[0].data[0], 0.5, 1e-5);
  expect_texel(maps.anisotropy[0], {1, 0.5, std::sqrt((0.5 - 0.25) / 0.75)});
}

TEST(LobeMaps, WhatGltfCannotSay) {
  KhrMaps maps = khr_maps(one(kWard, lobe_of(kWard, frame_of(0, 0), 1.5, 0.25)));
  EXPECT_EQ(maps.wider_texels, 1u);
  expect_texel(maps.anisotropy[0], {1, 0.5, 1});
  maps = khr_maps(one(kWard, lobe_of(kWard, frame_of(0, 0), 1.5, 1.2)));
  EXPECT_EQ(maps.wider_texels, 1u);
  EXPECT_EQ(maps.roughness[0].data[0], 1);
  expect_texel(maps.anisotropy[0], {1, 0.5, 0});
}

TEST(LobeMaps, BanksHasDirectionsOnly) {
  const MaterialTextures m = one(kBanks, lobe_of(kBanks, frame_of(0, 0), 1, 1));
  EXPECT_EQ(direction_maps(m).size(), 1u);
  EXPECT_ERROR(alpha_maps(m), ErrorKind::kUnsupported, "banks has no alpha");
  EXPECT_ERROR(khr_maps(m), ErrorKind::kUnsupported, "banks has no alpha");
}

}  // namespace
}  // namespace burnish
