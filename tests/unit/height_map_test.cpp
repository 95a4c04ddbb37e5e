#include "burnish/normal/height_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "burnish/core/parallel.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::ScratchDir;

constexpr int kNeighbors[] = {4, 8, 24, 48, 80};
constexpr FitWeights kWeights[] = {FitWeights::kUniform, FitWeights::kGaussian};
constexpr Wrap kWraps[] = {Wrap::kFit, Wrap::kClamp, Wrap::kRepeat, Wrap::kMirror};
constexpr const char* kWrapNames[] = {"fit", "clamp", "repeat", "mirror"};

struct Result {
  HeightMapStats stats;
  std::vector<Vec3f> normals;
};

Result convert(const ScratchDir& dir, const Image& heights, HeightMapOptions options, const ByteImage* mask = nullptr) {
  write_image(dir / "h.exr", FileType::kExr, SampleType::kFloat, heights);
  if (mask) {
    Image m(mask->width, mask->height);
    for (std::size_t i = 0; i < m.data.size(); i++) m.data[i] = mask->data[i] ? 1.f : 0.f;
    write_image(dir / "m.png", FileType::kPng, SampleType::kUint8, m);
    options.mask = FileRef(dir / "m.png");
  }
  NormalMapTarget target;
  target.file = FileRef(dir / "n.exr");
  target.type = FileType::kExr;
  target.sample = SampleType::kFloat;
  Result result;
  result.stats = convert_height_map(dir / "h.exr", options, target);
  int w, h;
  result.normals = read_normals(dir / "n.exr", {}, &w, &h);
  return result;
}

// --- The definition, written down once more: a dense weighted least-squares plane through the points
// themselves, in physical units and long double, with no use of symmetry, separability or centring.

// The texel that stands at i, or -1; straight from what the wraps say, one step at a time.
int walk(int i, int n, Wrap wrap) {
  while (i < 0 || i >= n) {
    if (wrap == Wrap::kFit) return -1;
    if (wrap == Wrap::kClamp) i += i < 0 ? 1 : -1;
    if (wrap == Wrap::kRepeat) i += i < 0 ? n : -n;
    if (wrap == Wrap::kMirror) i = i < 0 ? -1 - i : 2 * n - 1 - i;
  }
  return i;
}

struct Expected {
  Vec3d normal{0, 0, 1};
  bool degenerate = false;
};

Expected dense_fit(const Image& heights, const ByteImage* mask, const HeightMapOptions& o, int x, int y) {
  const int w = heights.width, h = heights.height;
  if (mask && !*mask->at(x, y)) return {};
  const int r = o.neighbors == 4 ? 1 : int(std::lround((std::sqrt(o.neighbors + 1.0) - 1) / 2));
  const long double size_u = o.size_u > 0 ? o.size_u : w, size_v = o.size_v > 0 ? o.size_v : size_u * h / w;
  const long double sigma = r / 2.0L;
  struct Point {
    int i, j;
    long double weight, height;
  };
  std::vector<Point> points;
  for (int j = -r; j <= r; j++)
    for (int i = -r; i <= r; i++) {
      if (o.neighbors == 4 && i != 0 && j != 0) continue;
      const int tx = walk(x + i, w, o.wrap_u), ty = walk(y - j, h, o.wrap_v);
      if (tx < 0 || ty < 0 || (mask && !*mask->at(tx, ty))) continue;
      const long double weight =
          o.weights == FitWeights::kUniform ? 1 : std::exp(-(i * i + j * j) / (2 * sigma * sigma));
      points.push_back({i, j, weight, o.height * (static_cast<long double>(*heights.at(tx, ty)) - o.mid_level)});
    }
  bool plane = false;
  for (const Point& a : points)
    for (const Point& b : points)
      plane = plane || (a.i - points[0].i) * (b.j - points[0].j) != (a.j - points[0].j) * (b.i - points[0].i);
  if (!plane) return {{0, 0, 1}, true};

  long double m[3][4] = {};  // normal equations of (a0, a1, a2)
  for (const Point& p : points) {
    const long double row[4] = {p.i * size_u / w, p.j * size_v / h, 1, p.height};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 4; b++) m[a][b] += p.weight * row[a] * row[b];
  }
  for (int c = 0; c < 3; c++) {
    int pivot = c;
    for (int i = c; i < 3; i++)
      if (std::fabs(m[i][c]) > std::fabs(m[pivot][c])) pivot = i;
    for (int k = 0; k < 4; k++) std::swap(m[c][k], m[pivot][k]);
    for (int i = 0; i < 3; i++) {
      if (i == c) continue;
      const long double f = m[i][c] / m[c][c];
      for (int k = 0; k < 4; k++) m[i][k] -= f * m[c][k];
    }
  }
  return {normalized(Vec3d{double(-m[0][3] / m[0][0]), double(-m[1][3] / m[1][1]), 1}), false};
}

std::string describe(const HeightMapOptions& o, int w, int h, bool masked) {
  return std::to_string(w) + "x" + std::to_string(h) + " q " + std::to_string(o.neighbors) +
         (o.weights == FitWeights::kUniform ? " uniform" : " gaussian") + " wrap " + kWrapNames[int(o.wrap_u)] + "," +
         kWrapNames[int(o.wrap_v)] + (masked ? " masked" : "");
}

// The contract allows 0.02°; the arithmetic is good for much less.
constexpr double kWorstDeg = 0.002;

void compare(const ScratchDir& dir, const Image& heights, const HeightMapOptions& o, const ByteImage* mask,
             int column_step = 1) {
  const int w = heights.width, h = heights.height;
  const Result result = convert(dir, heights, o, mask);
  std::size_t degenerate = 0;
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++) {
      if (x % column_step && x >= 6 && x < w - 6) continue;
      const Expected expected = dense_fit(heights, mask, o, x, y);
      degenerate += expected.degenerate;
      const double off = degrees(angle_rad(Vec3d(result.normals[std::size_t(y) * w + x]), expected.normal));
      ASSERT_LE(off, kWorstDeg) << describe(o, w, h, mask) << ", column " << x << ", row " << y;
    }
  if (column_step == 1) {
    ASSERT_EQ(result.stats.degenerate_texels, degenerate) << describe(o, w, h, mask);
  }
}

Image random_heights(int w, int h, unsigned seed, float base = 0, float range = 1) {
  std::mt19937 random(seed);
  Image image(w, h);
  for (float& v : image.data) v = base + range * float(random() % 65536) / 65535.f;
  return image;
}

ByteImage random_mask(int w, int h, unsigned seed, unsigned holes_in_ten) {
  std::mt19937 random(seed);
  ByteImage mask(w, h);
  for (std::uint8_t& m : mask.data) m = random() % 10 >= holes_in_ten;
  return mask;
}

class AgainstDenseSolve : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(AgainstDenseSolve, EveryNeighbourhoodWeightAndWrap) {
  const auto [w, h] = GetParam();
  const ScratchDir dir;
  const Image heights = random_heights(w, h, unsigned(w * 100 + h));
  for (const int q : kNeighbors)
    for (const FitWeights weights : kWeights)
      for (const Wrap u : kWraps)
        for (const Wrap v : kWraps) {
          HeightMapOptions o;
          o.neighbors = q, o.weights = weights, o.wrap_u = u, o.wrap_v = v;
          compare(dir, heights, o, nullptr);
          if (HasFatalFailure()) return;
        }
}

TEST_P(AgainstDenseSolve, MasksOfManyDensities) {
  const auto [w, h] = GetParam();
  const ScratchDir dir;
  const Image heights = random_heights(w, h, unsigned(w * 100 + h));
  for (const unsigned holes : {1u, 5u, 8u}) {
    const ByteImage mask = random_mask(w, h, 7 + holes, holes);
    for (const int q : kNeighbors)
      for (const FitWeights weights : kWeights)
        for (const Wrap wrap : kWraps) {
          HeightMapOptions o;
          o.neighbors = q, o.weights = weights, o.wrap_u = wrap, o.wrap_v = kWraps[(int(wrap) + 1) % 4];
          compare(dir, heights, o, &mask);
          o.wrap_v = wrap;
          compare(dir, heights, o, &mask);
          if (HasFatalFailure()) return;
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, AgainstDenseSolve,
                         ::testing::Values(std::pair{1, 1}, std::pair{1, 9}, std::pair{9, 1}, std::pair{2, 2},
                                           std::pair{3, 5}, std::pair{5, 3}, std::pair{8, 9}, std::pair{21, 17}),
                         [](const auto& i) {
                           return std::to_string(i.param.first) + "x" + std::to_string(i.param.second);
                         });

TEST(HeightMap, PhysicalUnitsAgainstTheDenseSolve) {
  const ScratchDir dir;
  const Image heights = random_heights(19, 13, 3);
  for (const int q : {4, 24})
    for (const Wrap wrap : {Wrap::kFit, Wrap::kRepeat})
      for (const auto& [height, u, v] :
           {std::tuple{0.1, 2.0, 0.0}, std::tuple{5.0, 3.0, 40.0}, std::tuple{-2.0, 19.0, 13.0},
            std::tuple{0.0, 1.0, 1.0}, std::tuple{60.0, 0.0, 0.0}}) {
        HeightMapOptions o;
        o.neighbors = q, o.wrap_u = o.wrap_v = wrap, o.height = height, o.size_u = u, o.size_v = v, o.mid_level = 0.5;
        compare(dir, heights, o, nullptr);
        if (HasFatalFailure()) return;
      }
}

// Elevations far above zero, as surveyors store them: differences must be taken before anything is summed up.
TEST(HeightMap, LargeOffsetsCostNoPrecision) {
  const ScratchDir dir;
  const Image heights = random_heights(30, 20, 4, 8000, 2);
  for (const int q : kNeighbors)
    for (const Wrap wrap : kWraps) {
      HeightMapOptions o;
      o.neighbors = q, o.wrap_u = o.wrap_v = wrap;
      compare(dir, heights, o, nullptr);
      if (HasFatalFailure()) return;
    }
}

// --- Closed forms.

TEST(HeightMap, AConstantHeightIsFlat) {
  const ScratchDir dir;
  for (const float level : {0.f, 0.3f, 1.f, -5000.f}) {
    Image heights(20, 15);
    for (float& v : heights.data) v = level;
    for (const int q : kNeighbors)
      for (const Wrap wrap : kWraps) {
        HeightMapOptions o;
        o.neighbors = q, o.wrap_u = o.wrap_v = wrap, o.height = 100;
        const Result result = convert(dir, heights, o);
        for (const Vec3f& n : result.normals) ASSERT_EQ(n, (Vec3f{0, 0, 1})) << describe(o, 20, 15, false);
        EXPECT_EQ(result.stats.max_slope_deg, 0);
        EXPECT_EQ(result.stats.mean_tilt_deg, 0);
        EXPECT_EQ(result.stats.degenerate_texels, 0u);
      }
  }
}

TEST(HeightMap, APlaneGivesItsSlopeEverywhere) {
  const ScratchDir dir;
  const int w = 24, h = 18;
  const double su = 0.75, sv = -0.5;  // per texel to the right and up; exact in float
  Image heights(w, h);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++) *heights.at(x, y) = float(su * x + sv * (h - 1 - y));
  const Vec3d expected = normalized(Vec3d{-su, -sv, 1});
  for (const int q : kNeighbors)
    for (const FitWeights weights : kWeights) {
      HeightMapOptions o;
      o.neighbors = q, o.weights = weights;
      const Result result = convert(dir, heights, o);
      for (std::size_t i = 0; i < result.normals.size(); i++)
        ASSERT_LT(degrees(angle_rad(Vec3d(result.normals[i]), expected)), 1e-4)
            << describe(o, w, h, false) << " texel " << i;
      const double slope = degrees(std::acos(expected.z));
      EXPECT_NEAR(result.stats.max_slope_deg, slope, 1e-3);
      EXPECT_NEAR(result.stats.mean_tilt_deg, slope, 1e-3);
      EXPECT_EQ(result.stats.width, w);
      EXPECT_EQ(result.stats.height, h);
    }
}

// y is up: ground that rises towards the top row leans the normal down.
TEST(HeightMap, DirectionsAreTheContracts) {
  const ScratchDir dir;
  Image rises_right(8, 8), rises_up(8, 8);
  for (int y = 0; y < 8; y++)
    for (int x = 0; x < 8; x++) *rises_right.at(x, y) = float(x), *rises_up.at(x, y) = float(-y);
  const float s = float(std::sqrt(0.5));
  for (const Vec3f& n : convert(dir, rises_right, {}).normals) {
    EXPECT_NEAR(n.x, -s, 1e-6);
    EXPECT_NEAR(n.y, 0, 1e-6);
  }
  for (const Vec3f& n : convert(dir, rises_up, {}).normals) {
    EXPECT_NEAR(n.x, 0, 1e-6);
    EXPECT_NEAR(n.y, -s, 1e-6);
  }
}

TEST(HeightMap, UnitsAndSizesScaleTheSlope) {
  const ScratchDir dir;
  Image ramp(10, 5);
  for (int y = 0; y < 5; y++)
    for (int x = 0; x < 10; x++) *ramp.at(x, y) = float(x) / 8;
  HeightMapOptions o;
  o.height = 0.1, o.size_u = 2;  // 10 cm over 2 m: a texel is 20 cm
  const Vec3d expected = normalized(Vec3d{-(0.1 / 8) / 0.2, 0, 1});
  for (const Vec3f& n : convert(dir, ramp, o).normals) EXPECT_LT(degrees(angle_rad(Vec3d(n), expected)), 1e-4);
  o.height = -0.1;
  const Vec3d inverted = normalized(Vec3d{(0.1 / 8) / 0.2, 0, 1});
  for (const Vec3f& n : convert(dir, ramp, o).normals) EXPECT_LT(degrees(angle_rad(Vec3d(n), inverted)), 1e-4);
}

TEST(HeightMap, MidLevelChangesNothing) {
  const ScratchDir dir;
  const Image heights = random_heights(12, 12, 9);
  HeightMapOptions o;
  const Result zero = convert(dir, heights, o);
  o.mid_level = 0.5;
  EXPECT_EQ(convert(dir, heights, o).normals, zero.normals);
}

// --- The pieces: the convolution's taps against fit_plane, and its own closed form.

TEST(PlaneFit, ConvolutionAndSolveAgreeOnWholeNeighbourhoods) {
  std::mt19937 random(11);
  for (const int q : kNeighbors)
    for (const FitWeights weights : kWeights) {
      const Neighborhood n = make_neighborhood(q, weights);
      ASSERT_EQ(int(n.taps.size()), q + 1);
      const int r = n.radius, side = 2 * r + 1;
      for (int repeat = 0; repeat < 20; repeat++) {
        std::vector<float> square(std::size_t(side) * side), d;
        for (float& v : square) v = float(random() % 65536) / 65535.f;
        const auto at = [&](int x, int y) { return double(square[std::size_t(y + r) * side + x + r]); };
        for (const auto& tap : n.taps) d.push_back(float(at(tap.x, tap.y)));
        const std::vector<char> ones(n.taps.size(), 1);
        const PlaneSlope slope = fit_plane(n, d.data(), reinterpret_cast<const bool*>(ones.data()));
        ASSERT_TRUE(slope.determined);
        double u = 0, v = 0;
        const int reach = int(n.smoothing.size()) - 1;
        for (int j = -reach; j <= reach; j++)
          for (int i = 1; i <= r; i++) {
            u += double(n.smoothing[std::abs(j)]) * n.derivative[i] * (at(i, j) - at(-i, j));
            v += double(n.smoothing[std::abs(j)]) * n.derivative[i] * (at(j, i) - at(j, -i));
          }
        EXPECT_NEAR(u, slope.a0, 1e-6) << "q " << q;
        EXPECT_NEAR(v, slope.a1, 1e-6) << "q " << q;
      }
    }
}

TEST(PlaneFit, GaussianWeightsAreOfHalfTheRadius) {
  for (const int q : kNeighbors) {
    const Neighborhood n = make_neighborhood(q, FitWeights::kGaussian);
    const double sigma = n.radius / 2.0;
    for (const auto& tap : n.taps)
      EXPECT_NEAR(tap.weight, std::exp(-(tap.x * tap.x + tap.y * tap.y) / (2 * sigma * sigma)), 1e-6)
          << "q " << q << " tap " << tap.x << "," << tap.y;
  }
}

TEST(PlaneFit, OtherNeighbourhoodsAreRefused) {
  for (const int q : {-1, 0, 1, 5, 9, 25, 81, 120})
    EXPECT_ERROR(make_neighborhood(q, FitWeights::kUniform), ErrorKind::kUsage, "expected 4, 8, 24, 48 or 80");
}

TEST(PlaneFit, PointsOnALineDetermineNothing) {
  const Neighborhood n = make_neighborhood(80, FitWeights::kUniform);
  const std::vector<float> d(n.taps.size(), 1.f);
  for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, -2}, std::pair{3, 1}}) {
    std::vector<char> exists(n.taps.size());
    for (std::size_t i = 0; i < n.taps.size(); i++) exists[i] = n.taps[i].x * dy == n.taps[i].y * dx;
    EXPECT_FALSE(fit_plane(n, d.data(), reinterpret_cast<const bool*>(exists.data())).determined)
        << "along " << dx << "," << dy;
  }
  const std::vector<char> none(n.taps.size());
  EXPECT_FALSE(fit_plane(n, d.data(), reinterpret_cast<const bool*>(none.data())).determined);
}

// The thinnest triangles that fit into a neighbourhood are still planes.
TEST(PlaneFit, AnyThreePointsOffALineDetermineThePlane) {
  for (const int q : kNeighbors)
    for (const FitWeights weights : kWeights) {
      const Neighborhood n = make_neighborhood(q, weights);
      std::vector<float> d;
      for (const auto& tap : n.taps) d.push_back(float(0.25 * tap.x - 0.5 * tap.y + 3));
      const std::size_t count = n.taps.size();
      for (std::size_t a = 0; a < count; a++)
        for (std::size_t b = a + 1; b < count; b++)
          for (std::size_t c = b + 1; c < count; c += 1 + count / 20) {
            const auto &ta = n.taps[a], &tb = n.taps[b], &tc = n.taps[c];
            if ((tb.x - ta.x) * (tc.y - ta.y) == (tb.y - ta.y) * (tc.x - ta.x)) continue;
            std::vector<char> exists(count);
            exists[a] = exists[b] = exists[c] = 1;
            const PlaneSlope slope = fit_plane(n, d.data(), reinterpret_cast<const bool*>(exists.data()));
            ASSERT_TRUE(slope.determined) << "q " << q << " taps " << a << ", " << b << ", " << c;
            ASSERT_NEAR(slope.a0, 0.25, 1e-5) << "q " << q << " taps " << a << ", " << b << ", " << c;
            ASSERT_NEAR(slope.a1, -0.5, 1e-5) << "q " << q << " taps " << a << ", " << b << ", " << c;
          }
    }
}

// --- Bands: what a map is cut into must not show. Bands have 64 to 4096 rows.

TEST(HeightMapBands, TallMapsForEveryWrap) {
  const ScratchDir dir;
  for (const int h : {4096, 4097, 4100, 4101, 8195})
    for (const Wrap wrap : kWraps)
      for (const bool masked : {false, true}) {
        const Image heights = random_heights(3, h, unsigned(h));
        const ByteImage mask = random_mask(3, h, 12, 3);
        HeightMapOptions o;
        o.neighbors = masked ? 24 : 80, o.wrap_u = Wrap::kRepeat, o.wrap_v = wrap;
        compare(dir, heights, o, masked ? &mask : nullptr);
        if (HasFatalFailure()) return;
      }
}

TEST(HeightMapBands, WideMapsForEveryWrap) {
  const ScratchDir dir;
  const int w = 20011;
  for (const int h : {65, 68, 131}) {
    const Image heights = random_heights(w, h, unsigned(h));
    for (const Wrap wrap : kWraps) {
      HeightMapOptions o;
      o.neighbors = 80, o.wrap_u = o.wrap_v = wrap;
      compare(dir, heights, o, nullptr, 1777);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(HeightMapBands, ThreadsDoNotShowInTheBytes) {
  const ScratchDir dir;
  write_image(dir / "h.tif", FileType::kTiff, SampleType::kUint16, random_heights(7001, 200, 6));
  for (const char* file : {"n.png", "n.tif", "n.exr"}) {
    std::string first;
    HeightMapStats stats;
    for (const int threads : {1, 2, 8, 0}) {
      const ThreadLimit limit(threads);
      HeightMapOptions o;
      o.neighbors = 24, o.wrap_v = Wrap::kRepeat;
      NormalMapTarget target;
      target.file = FileRef(dir / file);
      target.type = file_type_of(file);
      target.sample = default_sample_type(target.type);
      const HeightMapStats s = convert_height_map(dir / "h.tif", o, target);
      const std::string bytes = bytes_of(dir / file);
      if (first.empty()) first = bytes, stats = s;
      EXPECT_TRUE(bytes == first) << file << " with " << threads << " threads";
      EXPECT_EQ(s.mean_tilt_deg, stats.mean_tilt_deg);
      EXPECT_EQ(s.max_slope_deg, stats.max_slope_deg);
    }
  }
}

TEST(HeightMapBands, ProgressNeverFallsAndEndsAtOne) {
  const ScratchDir dir;
  write_image(dir / "h.exr", FileType::kExr, SampleType::kFloat, random_heights(3, 9000, 1));
  NormalMapTarget target;
  target.file = FileRef(dir / "n.png");
  double last = 0;
  convert_height_map(dir / "h.exr", {}, target, [&](double f) {
    EXPECT_GE(f, last);
    last = f;
  });
  EXPECT_EQ(last, 1);
}

// --- Inputs of other kinds, and what is refused.

TEST(HeightMap, IntegersAreNormalised) {
  const ScratchDir dir;
  Image ramp(16, 4);
  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 16; x++) *ramp.at(x, y) = float(x * 17) / 255;
  write_image(dir / "h8.png", FileType::kPng, SampleType::kUint8, ramp);
  write_image(dir / "h16.png", FileType::kPng, SampleType::kUint16, ramp);  // 17·257/65535 is 17/255
  HeightMapOptions o;
  o.height = 15;
  NormalMapTarget target;
  target.file = FileRef(dir / "n.exr");
  target.type = FileType::kExr;
  target.sample = SampleType::kFloat;
  for (const char* file : {"h8.png", "h16.png"}) {
    convert_height_map(dir / file, o, target);
    int w, h;
    for (const Vec3f& n : read_normals(dir / "n.exr", {}, &w, &h))
      ASSERT_LT(degrees(angle_rad(Vec3d(n), {-1, 0, 1})), 1e-3) << file;
  }
}

TEST(HeightMap, ChannelsByNameAndNumber) {
  const ScratchDir dir;
  Image rgb(8, 8, 3);
  for (int y = 0; y < 8; y++)
    for (int x = 0; x < 8; x++) rgb.at(x, y)[0] = 0, rgb.at(x, y)[1] = float(x), rgb.at(x, y)[2] = float(-x);
  const auto slope = [&](const std::string& channel) {
    HeightMapOptions o;
    o.channel = channel;
    return convert(dir, rgb, o).normals[0].x;
  };
  EXPECT_EQ(slope(""), 0.f);
  EXPECT_EQ(slope("R"), 0.f);
  EXPECT_LT(slope("G"), 0.f);
  EXPECT_LT(slope("g"), 0.f);
  EXPECT_LT(slope("1"), 0.f);
  EXPECT_GT(slope("B"), 0.f);
  EXPECT_GT(slope("2"), 0.f);
  for (const char* wrong : {"A", "3", "-1", "height"})
    EXPECT_ERROR(slope(wrong), ErrorKind::kMalformed, "expected channel");
}

TEST(HeightMap, DifferingColoursAreNoticedUnlessAChannelWasChosen) {
  const ScratchDir dir;
  Image rgb(4, 4, 3);
  EXPECT_FALSE(convert(dir, rgb, {}).stats.colour_channels_differ);
  rgb.at(3, 3)[2] = 0.5f;
  EXPECT_TRUE(convert(dir, rgb, {}).stats.colour_channels_differ);
  HeightMapOptions o;
  o.channel = "R";
  EXPECT_FALSE(convert(dir, rgb, o).stats.colour_channels_differ);
}

TEST(HeightMap, NaNIsRefusedUnlessTheMaskExcludesIt) {
  const ScratchDir dir;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    Image heights = random_heights(9, 9, 2);
    *heights.at(4, 5) = bad;
    EXPECT_ERROR(convert(dir, heights, {}), ErrorKind::kMalformed, "column 4, row 5");
    ByteImage mask(9, 9);
    for (auto& m : mask.data) m = 1;
    EXPECT_ERROR(convert(dir, heights, {}, &mask), ErrorKind::kMalformed, "column 4, row 5");
    *mask.at(4, 5) = 0;
    const Result result = convert(dir, heights, {}, &mask);
    for (const Vec3f& n : result.normals) ASSERT_TRUE(std::isfinite(n.x + n.y + n.z));
    EXPECT_EQ(result.normals[5 * 9 + 4], (Vec3f{0, 0, 1}));
  }
}

TEST(HeightMap, AMaskOfNothingMakesAFlatMap) {
  const ScratchDir dir;
  const ByteImage nothing(6, 5);
  const Result result = convert(dir, random_heights(6, 5, 1), {}, &nothing);
  for (const Vec3f& n : result.normals) EXPECT_EQ(n, (Vec3f{0, 0, 1}));
  EXPECT_EQ(result.stats.degenerate_texels, 0u) << "only texels that take part can be degenerate";
  EXPECT_EQ(result.stats.mean_tilt_deg, 0);
}

TEST(HeightMap, NumbersOutOfRangeAndMasksThatDoNotFit) {
  const ScratchDir dir;
  const Image heights = random_heights(6, 5, 1);
  const auto with = [&](auto change) {
    HeightMapOptions o;
    change(o);
    return convert(dir, heights, o);
  };
  EXPECT_ERROR(with([](auto& o) { o.height = NAN; }), ErrorKind::kUsage, "height");
  EXPECT_ERROR(with([](auto& o) { o.height = INFINITY; }), ErrorKind::kUsage, "height");
  EXPECT_ERROR(with([](auto& o) { o.mid_level = NAN; }), ErrorKind::kUsage, "mid-level");
  EXPECT_ERROR(with([](auto& o) { o.size_u = -1; }), ErrorKind::kUsage, "size");
  EXPECT_ERROR(with([](auto& o) { o.size_v = NAN; }), ErrorKind::kUsage, "size");
  EXPECT_ERROR(with([](auto& o) { o.neighbors = 5; }), ErrorKind::kUsage, "neighbors");
  const ByteImage other(5, 6);
  EXPECT_ERROR(convert(dir, heights, {}, &other), ErrorKind::kMalformed, "expected 6x5");
}

}  // namespace
}  // namespace burnish
