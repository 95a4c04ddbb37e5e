#include <gtest/gtest.h>

#include <set>

#include "burnish/core/parallel.h"
#include "burnish/palette/fit/colour_codebook.h"
#include "burnish/palette/fit/median_cut.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::Random;

double distance2(const Colour& a, const Colour& b) {
  double d = 0;
  for (int i = 0; i < 4; i++) d += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
  return d;
}

int brute_nearest(const std::vector<Colour>& entries, const Colour& c) {
  int best = 0;
  for (std::size_t i = 1; i < entries.size(); i++)
    if (distance2(entries[i], c) < distance2(entries[best], c)) best = int(i);
  return best;
}

double brute_error(const std::vector<WeightedColour>& points, const std::vector<Colour>& entries) {
  double error = 0;
  for (const WeightedColour& p : points)
    error += p.weight * distance2(p.colour, entries[brute_nearest(entries, p.colour)]);
  return error;
}

// Distinct colours: a bowl of normals in each of `materials` alphas.
std::vector<WeightedColour> bowls(int count, int materials, std::uint32_t seed) {
  Random random(seed);
  std::set<Colour> seen;
  std::vector<WeightedColour> points;
  for (int i = 0; i < count; i++) {
    const Vec3f n = random.in_cap(70);
    const auto byte = [](float v) { return std::floor(127.5f * v + 128); };
    const Colour c{byte(n.x), byte(n.y), byte(n.z), 255 - 60.f * float(random.below(materials))};
    if (seen.insert(c).second) points.push_back({c, float(1 + random.below(30))});
  }
  return points;
}

TEST(PaletteColourCodebook, NoMorePointsThanEntriesAreTheEntries) {
  const std::vector<WeightedColour> points = bowls(50, 3, 1);
  for (const int n : {50, 51, 1000}) {
    const std::vector<Colour> entries = fit_colour_codebook(points, n);
    ASSERT_EQ(entries.size(), points.size());
    EXPECT_LT(brute_error(points, entries), 1e-6);
  }
}

TEST(PaletteColourCodebook, ClustersGetAnEntryEach) {
  Random random(2);
  const std::vector<Colour> middles{{30, 40, 50, 255}, {200, 40, 50, 255}, {30, 220, 50, 255}, {30, 40, 50, 100}};
  std::vector<WeightedColour> points;
  for (const Colour& m : middles)
    for (int dx = -2; dx <= 2; dx++)
      for (int dy = -2; dy <= 2; dy++) points.push_back({{m[0] + float(dx), m[1] + float(dy), m[2], m[3]}, 1});
  const std::vector<Colour> entries = fit_colour_codebook(points, 4);
  ASSERT_EQ(entries.size(), 4u);
  for (const Colour& m : middles) EXPECT_LT(distance2(entries[brute_nearest(entries, m)], m), 1e-6);
}

TEST(PaletteColourCodebook, EntriesAreNearlyTheMeansOfWhatIsNearestToThem) {
  const std::vector<WeightedColour> points = bowls(6000, 3, 3);
  for (const int n : {1, 2, 7, 64, 300}) {
    const std::vector<Colour> entries = fit_colour_codebook(points, n);
    ASSERT_EQ(int(entries.size()), n);
    std::vector<Colour> mean(n);
    std::vector<std::array<double, 5>> sums(n);
    for (const WeightedColour& p : points) {
      auto& s = sums[brute_nearest(entries, p.colour)];
      for (int a = 0; a < 4; a++) s[a] += double(p.weight) * p.colour[a];
      s[4] += p.weight;
    }
    for (int k = 0; k < n; k++) {
      ASSERT_GT(sums[k][4], 0) << "an entry that nothing is nearest to";
      for (int a = 0; a < 4; a++) mean[k][a] = float(sums[k][a] / sums[k][4]);
    }
    const double error = brute_error(points, entries);
    EXPECT_GE(brute_error(points, mean), 0.995 * error) << n << " entries: a further iteration gains";
    EXPECT_LT(error, brute_error(points, fit_median_cut(points, n)) * (n > 1 ? 1 : 1 + 1e-6)) << n;
  }
}

TEST(PaletteColourCodebook, TheSameForAnyNumberOfThreads) {
  const std::vector<WeightedColour> points = bowls(30000, 2, 4);
  std::vector<Colour> entries[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    entries[threads - 1] = fit_colour_codebook(points, 500);
  }
  EXPECT_EQ(entries[0], entries[1]);
}

TEST(PaletteColourCodebook, MedianCutOfNormalsIsThatOfTheirColours) {
  // Of the vectors themselves, as the split encoding cuts them, or of the same scaled into the cube.
  Random random(5);
  std::vector<WeightedNormal> normals;
  std::vector<WeightedColour> colours;
  for (int i = 0; i < 3000; i++) {
    const Vec3f n = random.in_cap(80);
    normals.push_back({n, float(1 + random.below(9))});
    colours.push_back({{n.x * 64 + 128, n.y * 64 + 128, n.z * 64 + 128, 255}, normals.back().weight});
  }
  const std::vector<Vec3f> entries = fit_median_cut(normals, 100);
  const std::vector<Colour> cells = fit_median_cut(colours, 100);
  ASSERT_EQ(entries.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); i++) {
    const Vec3d v = normalized(Vec3d{cells[i][0] - 128.0, cells[i][1] - 128.0, cells[i][2] - 128.0});
    EXPECT_LT(testing::angle_deg(entries[i], Vec3f(v)), 0.01);
    EXPECT_EQ(cells[i][3], 255);
  }
}

}  // namespace
}  // namespace burnish
