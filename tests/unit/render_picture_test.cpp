#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/render/metrics.h"
#include "burnish/render/picture.h"

namespace burnish {
namespace {

TEST(RenderPicture, SrgbTransferValues) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_NEAR(srgb_from_linear(1), 1, 1e-15);
  EXPECT_NEAR(srgb_from_linear(0.0031308), 0.04045, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.001), 0.01292, 1e-12);
  EXPECT_NEAR(srgb_from_linear(0.21404114), 0.5, 1e-7);
  EXPECT_NEAR(srgb_from_linear(0.5), 0.73535698, 1e-7);
  EXPECT_EQ(srgb_from_linear(-1), 0);
  EXPECT_NEAR(srgb_from_linear(7), 1, 1e-15);
}

TEST(RenderPicture, ExposureCountsStops) {
  Image linear(1, 1, 3);
  linear.data = {0.125f, 0.25f, 2};
  const Image srgb = srgb_picture(linear, 1);
  EXPECT_FLOAT_EQ(srgb.data[0], float(srgb_from_linear(0.25)));
  EXPECT_FLOAT_EQ(srgb.data[1], float(srgb_from_linear(0.5)));
  EXPECT_FLOAT_EQ(srgb.data[2], 1);
}

TEST(RenderPicture, HeatGrowsInLightness) {
  double last = -1;
  for (int i = 0; i <= 100; i++) {
    const Vec3d c = heat_colour(i / 100.);
    const double lightness = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
    EXPECT_GT(lightness, last) << i;
    last = lightness;
  }
  EXPECT_EQ(heat_colour(2), heat_colour(1));
}

TEST(RenderPicture, HeatShowsTheWorstChannelAndGreyOffTheObject) {
  Image a(2, 1, 3), b(2, 1, 3);
  a.data = {0, 0.5f, 0, 1, 1, 1};
  ByteImage counts(2, 1);
  counts.data = {1, 0};
  const Image heat = heat_picture(a, b, counts, 0.5);
  EXPECT_FLOAT_EQ(heat.data[0], float(heat_colour(1).x));
  EXPECT_FLOAT_EQ(heat.data[2], float(heat_colour(1).z));
  EXPECT_EQ(heat.data[3], heat.data[5]);
}

TEST(RenderMetrics, KnownArrays) {
  Image a(2, 1, 3), b(2, 1, 3);
  a.data = {0, 0, 0, 0, 0, 0};
  b.data = {0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.3f};
  ByteImage all(2, 1);
  all.data = {1, 1};
  const ErrorMetrics m = compare(a, b, all);
  EXPECT_EQ(m.pixels, 2u);
  EXPECT_NEAR(m.rmse, std::sqrt((5 * 0.01 + 0.09) / 6), 1e-8);
  EXPECT_NEAR(m.psnr_db, -20 * std::log10(m.rmse), 1e-12);
  EXPECT_NEAR(m.max_abs, 0.3, 1e-7);
  EXPECT_NEAR(m.p95_abs, 0.3, 1e-7);
  ByteImage first(2, 1);
  first.data = {1, 0};
  EXPECT_NEAR(compare(a, b, first).psnr_db, 20, 1e-5);
}

TEST(RenderMetrics, NinetyFivePerCentByNearestRank) {
  Image a(100, 1, 1), b(100, 1, 1);
  for (int i = 0; i < 100; i++) b.data[i] = float((i * 37) % 100 + 1);
  ByteImage all(100, 1);
  all.data.assign(100, 1);
  EXPECT_EQ(compare(a, b, all).p95_abs, 95);
}

TEST(RenderMetrics, EqualPicturesHaveNoNoise) {
  Image a(3, 3, 3);
  ByteImage all(3, 3);
  all.data.assign(9, 1);
  const ErrorMetrics m = compare(a, a, all);
  EXPECT_EQ(m.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(m.max_abs, 0);
}

}  // namespace
}  // namespace burnish
