#include "burnish/ptm/ptm_normals.h"

#include <gtest/gtest.h>

#include <random>

#include "burnish/ptm/brightest_direction.h"
#include "burnish/ptm/relight.h"
#include "expect_error.h"
#include "ptm_map_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::made_up_map;
using testing::ScratchDir;
using Coefficients = PtmCoefficients<double>;

// The most over a fine grid of the disc, and over its circle.
double most_of_all(const Coefficients& a) {
  double most = -INFINITY;
  for (int i = 0; i < 20000; i++) {
    const double angle = 2 * kPi * i / 20000;
    most = std::max(most, evaluate(a, std::cos(angle), std::sin(angle)));
  }
  for (int y = -200; y <= 200; y++)
    for (int x = -200; x <= 200; x++)
      if (x * x + y * y <= 40000) most = std::max(most, evaluate(a, x / 200.0, y / 200.0));
  return most;
}

void expect_brightest(const Coefficients& a, const std::string& what) {
  const BrightestDirection found = brightest_direction(a);
  const Vec3d n = found.direction;
  EXPECT_NEAR(length(n), 1, 1e-12) << what;
  EXPECT_GE(n.z, 0) << what;
  EXPECT_EQ(found.on_horizon, n.z == 0) << what;
  double size = 0;
  for (const double c : a) size = std::max(size, std::abs(c));
  EXPECT_GE(evaluate(a, n.x, n.y), most_of_all(a) - 1e-9 * size) << what;
}

TEST(BrightestDirection, IsTheMostOverTheDisc) {
  std::mt19937 random(3);
  const auto number = [&] { return double(random()) / 2147483648.0 - 1; };
  for (int i = 0; i < 150; i++) {
    Coefficients a{number(), number(), number(), number(), number(), number()};
    if (i % 3 == 0) a[0] -= 2, a[1] -= 2;  // mostly bent down: inside
    if (i % 5 == 0) a[3] *= 0.01, a[4] *= 0.01;
    for (double& c : a) c *= 100;
    expect_brightest(a, "polynomial " + std::to_string(i));
  }
}

TEST(BrightestDirection, IsTheMostWhereAxesAndSlopesCoincide) {
  for (const Coefficients& a : {Coefficients{1, -1, 0, 0, 0, 0},  // a saddle: two ends alike
                                {-1, 1, 0, 0, 0, 0},
                                {0, 0, 2, 0, 0, 0},
                                {2, 2, 0, 0, 0, 0},  // a bowl: all of the circle alike
                                {2, 2, 0, 1, 0, 0},
                                {1, -1, 0, 0, 1, 0},  // no slope along the axis that bends up
                                {1, -1, 0, 0, 9, 0},
                                {0, -1, 0, 0, 1, 0},  // a ridge
                                {0, -1, 0, 1e-9, 1, 0},
                                {-1, -1, 0, 2, 0, 0},  // the stationary point on the circle itself
                                {-1, -1, 0, 0, 0, 0},
                                {0, 0, 0, 3, -4, 0},  // a plane
                                {1e-7, 0, 0, 1, 0, 0},
                                {3, 1, 1e-12, 1e-12, 4, 0}})
    expect_brightest(a, "polynomial of " + std::to_string(a[0]) + ", " + std::to_string(a[1]));
}

// Where the stationary point lies beyond the disc, bringing it back along its radius would not do.
TEST(BrightestDirection, IsNotTheStationaryPointBroughtBack) {
  const Coefficients a{-10, -1, 0, 30, 4, 100};  // stationary at (1.5, 2)
  const Vec3d n = brightest_direction(a).direction;
  EXPECT_GT(evaluate(a, n.x, n.y), evaluate(a, 0.6, 0.8) + 1);
}

TEST(BrightestDirection, ClosedForms) {
  // (n·l)² of n = (0.36, 0.48, 0.8) would be bent down only along n; −|l − n|² is brightest at n.
  const Coefficients toward{-50, -50, 0, 36, 48, 10};
  const Vec3d n = brightest_direction(toward).direction;
  EXPECT_NEAR(n.x, 0.36, 1e-15);
  EXPECT_NEAR(n.y, 0.48, 1e-15);
  EXPECT_NEAR(n.z, 0.8, 1e-15);
  for (const Coefficients& same : {Coefficients{0, 0, 0, 0, 0, 90}, {1e-4, -1e-4, 0, 1e-4, 0, 255}, {}}) {
    EXPECT_TRUE(brightest_direction(same).flat);
    EXPECT_EQ(brightest_direction(same).direction, (Vec3d{0, 0, 1}));
  }
  EXPECT_EQ(brightest_direction({4, 0, 0, 0, 0, 0}).direction, (Vec3d{1, 0, 0}));
  EXPECT_EQ(brightest_direction({0, 4, 0, 0, 0, 0}).direction, (Vec3d{0, 1, 0}));
}

TEST(PtmNormals, OfTheSumOfChannels) {
  const ScratchDir dir;
  const Ptm map = made_up_map(PtmType::kRgb, 9, 4);
  const NormalMapTarget target{dir / "n.exr", FileType::kExr, SampleType::kFloat, {}};
  const PtmNormalStats stats = write_ptm_normals(PtmInMemory(map), target);
  EXPECT_EQ(stats.flat_texels, 0u);
  const Image image = read_image(dir / "n.exr");
  double tilt = 0;
  for (std::size_t i = 0; i < map.texels(); i++) {
    Coefficients sum{};
    for (int c = 0; c < 18; c++) sum[c % kPtmTerms] += map.coefficients[i * 18 + c];
    const Vec3d n = brightest_direction(sum).direction;
    EXPECT_NEAR(image.data[3 * i], n.x, 1e-6);
    EXPECT_NEAR(image.data[3 * i + 1], n.y, 1e-6);
    EXPECT_NEAR(image.data[3 * i + 2], n.z, 1e-6);
    tilt += degrees(std::acos(n.z)) / double(map.texels());
  }
  EXPECT_NEAR(stats.mean_tilt_deg, tilt, 1e-6);
}

TEST(Relight, ShowsWhatTheMapSays) {
  const ScratchDir dir;
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const Ptm map = made_up_map(type, 11, 5);
    relight(PtmInMemory(map), {0.9, -1.2, 2}, dir / "l.exr", FileType::kExr, SampleType::kFloat);
    const Image image = read_image(dir / "l.exr");
    const Vec3d light = normalized(Vec3d{0.9, -1.2, 2});
    for (std::size_t i = 0; i < map.texels(); i++)
      for (int c = 0; c < 3; c++)
        EXPECT_NEAR(image.data[3 * i + c], map.lit(i, float(light.x), float(light.y))[c] / 255, 1e-5);
  }
  for (const Vec3d light :
       {Vec3d{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 0, INFINITY}, {0, NAN, 1}, {1e-320, 0, 1e-320}, {1e308, 0, 1e308}})
    EXPECT_ERROR(relight(PtmInMemory(made_up_map(PtmType::kRgb, 2, 2)), light, dir / "x.png", FileType::kPng,
                         SampleType::kUint8),
                 ErrorKind::kUsage, "light: expected a direction from above the surface");
}

}  // namespace
}  // namespace burnish
