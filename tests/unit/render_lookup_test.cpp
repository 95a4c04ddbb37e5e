#include <gtest/gtest.h>

#include "burnish/render/lookup.h"
#include "burnish/render/mip_level.h"

namespace burnish {
namespace {

TEST(RenderLookup, TexelCentresFindTheirTexel) {
  for (int y = 0; y < 5; y++)
    for (int x = 0; x < 7; x++) {
      const TexelPosition t = nearest_texel((x + 0.5) / 7, 1 - (y + 0.5) / 5, 7, 5, {});
      EXPECT_EQ(t.x, x);
      EXPECT_EQ(t.y, y);
    }
}

TEST(RenderLookup, RepeatsOrEnds) {
  EXPECT_EQ(nearest_texel(1.1, 0.5, 4, 4, {}).x, 0);
  EXPECT_EQ(nearest_texel(-0.1, 0.5, 4, 4, {}).x, 3);
  EXPECT_EQ(nearest_texel(0.5, 1.1, 4, 4, {}).y, 3);
  EXPECT_EQ(nearest_texel(0.5, -0.1, 4, 4, {}).y, 0);
  EXPECT_EQ(nearest_texel(0.5, 1, 4, 4, {false}).y, 0);
  EXPECT_EQ(nearest_texel(0.5, 0, 4, 4, {false}).y, 3);
}

TEST(RenderLookup, BilinearWeighsByDistance) {
  const BilinearTaps centre = bilinear_taps(1.5 / 4, 1 - 2.5 / 4, 4, 4, {});
  EXPECT_EQ(centre.texel[0].x, 1);
  EXPECT_EQ(centre.texel[0].y, 2);
  EXPECT_NEAR(centre.weight[0], 1, 1e-12);
  const BilinearTaps between = bilinear_taps(2.25 / 4, 1 - 2.5 / 4, 4, 4, {});
  EXPECT_EQ(between.texel[0].x, 1);
  EXPECT_EQ(between.texel[1].x, 2);
  EXPECT_NEAR(between.weight[0], 0.25, 1e-12);
  EXPECT_NEAR(between.weight[1], 0.75, 1e-12);
  const BilinearTaps corner = bilinear_taps(0, 1, 4, 4, {});
  EXPECT_EQ(corner.texel[0].x, 3);
  EXPECT_EQ(corner.texel[0].y, 3) << "repeats";
  const BilinearTaps pole = bilinear_taps(0, 1, 4, 4, {false});
  EXPECT_EQ(pole.texel[0].y, 0);
  EXPECT_EQ(pole.texel[2].y, 0);
}

TEST(RenderMipLevel, TheFootprintInTexelsChoosesTheLevel) {
  const auto level = [](double texels_per_pixel, int samples = 1) {
    SurfacePoint p{};
    p.du_dx = texels_per_pixel / 256, p.dv_dy = 0.1 / 256;
    return nearest_level(mip_lambda(p, 256, 256, samples, 9));
  };
  EXPECT_EQ(level(0.25), 0);
  EXPECT_EQ(level(1), 0);
  EXPECT_EQ(level(1.41), 0);  // √2 is the border between levels 0 and 1
  EXPECT_EQ(level(1.42), 1);
  EXPECT_EQ(level(2), 1);
  EXPECT_EQ(level(4), 2);
  EXPECT_EQ(level(4, 2), 1) << "a footprint is a sample's";
  EXPECT_EQ(level(256), 8);
  EXPECT_EQ(level(1e12), 8) << "stays inside the chain";
  EXPECT_EQ(level(INFINITY), 8);
}

TEST(RenderMipLevel, TheLongerSideOfTheFootprintCounts) {
  SurfacePoint p{};
  p.du_dx = 1. / 64, p.dv_dy = 8. / 64;
  EXPECT_NEAR(mip_lambda(p, 64, 64, 1, 7), 3, 1e-12);
  EXPECT_NEAR(mip_lambda(p, 64, 32, 1, 7), 2, 1e-12);
}

}  // namespace
}  // namespace burnish
