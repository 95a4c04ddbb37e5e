#include <gtest/gtest.h>

#include <set>

#include "burnish/core/parallel.h"
#include "burnish/palette/codebook.h"
#include "expect_error.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::brute_error;
using testing::Random;
using Groups = std::vector<std::vector<WeightedNormal>>;

// Clusters of different size and density, with integer weights.
std::vector<WeightedNormal> clustered(int n, std::uint32_t seed) {
  Random random(seed);
  const std::vector<Vec3f> centres = random.directions(9);
  std::vector<WeightedNormal> points;
  for (int i = 0; i < n; i++) {
    const int c = random.below(random.below(9) + 1);
    const Vec3d v = Vec3d(centres[c]) + Vec3d(random.direction()) * (0.05 * (c + 1) * random.unit());
    points.push_back({Vec3f(normalized(v)), float(1 + random.below(5))});
  }
  return points;
}

double rms_deg(std::span<const WeightedNormal> points, std::span<const Vec3f> entries) {
  double squares = 0, weight = 0;
  for (const WeightedNormal& p : points) {
    const double a = testing::angle_deg(p.normal, entries[testing::brute_nearest(entries, p.normal)]);
    squares += p.weight * a * a, weight += p.weight;
  }
  return std::sqrt(squares / weight);
}

double total_error(const Groups& groups, const Codebook& book) {
  double error = 0;
  for (std::size_t g = 0; g < groups.size(); g++) error += brute_error(groups[g], book.groups[g]);
  return error;
}

void expect_unit(const Codebook& book) {
  for (const auto& entries : book.groups)
    for (const Vec3f& e : entries) ASSERT_NEAR(length(Vec3d(e)), 1, 1e-6);
}

TEST(PaletteCodebook, NoMorePointsThanEntriesAreTheEntries) {
  Random random(1);
  for (const int points : {1, 2, 7, 64}) {
    const std::vector<Vec3f> normals = random.directions(points);
    const Codebook book = fit_codebook(Groups{testing::weighted(normals, 3)}, 64);
    ASSERT_EQ(book.groups.size(), 1u);
    EXPECT_EQ(book.size(), points);
    EXPECT_EQ(book.error, 0);
    for (const Vec3f& n : normals) EXPECT_NE(std::ranges::find(book.groups[0], n), book.groups[0].end()) << points;
  }
}

TEST(PaletteCodebook, ReportsTheErrorThatBruteForceFinds) {
  for (const int n : {2, 3, 16, 100, 700}) {
    const Groups groups{clustered(3000, 2)};
    const Codebook book = fit_codebook(groups, n);
    ASSERT_EQ(book.size(), n);
    expect_unit(book);
    const double brute = total_error(groups, book);
    EXPECT_NEAR(book.error, brute, 2e-3 * brute + 1e-4) << n << " entries";
  }
}

TEST(PaletteCodebook, NoEntryGainsByMovingToItsCentroid) {
  const Groups groups{clustered(4000, 3)};
  const int n = 60;
  const Codebook book = fit_codebook(groups, n);
  const std::vector<Vec3f>& entries = book.groups[0];
  const double before = total_error(groups, book);
  std::vector<Vec3d> sum(n);
  for (const WeightedNormal& p : groups[0])
    sum[testing::brute_nearest(entries, p.normal)] += Vec3d(p.normal) * double(p.weight);
  double at_once = before;
  for (int k = 0; k < n; k++) {
    ASSERT_GT(length(sum[k]), 0) << "entry " << k << " serves nobody";
    Codebook moved = book;
    moved.groups[0][k] = Vec3f(normalized(sum[k]));
    const double after = total_error(groups, moved);
    EXPECT_LT(before - after, 1e-3 * before) << "entry " << k;
    at_once -= std::max(0.0, before - after);
  }
  EXPECT_LT(before - at_once, 5e-3 * before);
}

TEST(PaletteCodebook, NoWorseThanLloydFromRandomEntries) {
  for (const int n : {8, 50, 300}) {
    const Groups groups{clustered(3000, 4)};
    Random random{std::uint32_t(n)};
    std::vector<Vec3f> entries;
    for (int k = 0; k < n; k++) entries.push_back(groups[0][random.below(3000)].normal);
    for (int iteration = 0; iteration < 30; iteration++) {
      std::vector<Vec3d> sum(n);
      for (const WeightedNormal& p : groups[0])
        sum[testing::brute_nearest(entries, p.normal)] += Vec3d(p.normal) * double(p.weight);
      for (int k = 0; k < n; k++)
        if (length(sum[k]) > 0) entries[k] = Vec3f(normalized(sum[k]));
    }
    EXPECT_LT(fit_codebook(groups, n).error, brute_error(groups[0], entries)) << n << " entries";
  }
}

// 5.084° is the RMS radius of 256 hexagonal cells that share the sphere.
TEST(PaletteCodebook, AUniformSphereIsCoveredAsWellAsHexagonsCould) {
  const Groups groups{testing::weighted(testing::fibonacci_sphere(200000))};
  const Codebook book = fit_codebook(groups, 256);
  expect_unit(book);
  const double rms = rms_deg(groups[0], book.groups[0]);
  EXPECT_LT(rms, 1.03 * 5.084);
  EXPECT_GT(rms, 0.99 * 5.084);
}

TEST(PaletteCodebook, WeightCountsLikeRepetition) {
  // Of two close points the entry between them leans to the heavier.
  const Vec3f a{0, 0, 1}, b{0.1f, 0, 0.99498744f}, far{0, 0, -1};
  const Codebook book = fit_codebook(Groups{{{a, 9}, {b, 1}, {far, 1}}}, 2);
  ASSERT_EQ(book.size(), 2);
  const Vec3f mean = Vec3f(normalized(Vec3d(a) * 9.0 + Vec3d(b)));
  double closest = 180;
  for (const Vec3f& e : book.groups[0]) closest = std::min(closest, testing::angle_deg(e, mean));
  EXPECT_LT(closest, 0.02);
}

TEST(PaletteCodebook, WeightsOfAnySizeGiveTheSameEntries) {
  std::vector<WeightedNormal> points = clustered(2000, 5);
  const Codebook light = fit_codebook(Groups{points}, 40);
  for (WeightedNormal& p : points) p.weight *= 1024;  // a power of two: nothing is rounded
  const Codebook heavy = fit_codebook(Groups{points}, 40);
  EXPECT_EQ(light.groups, heavy.groups);
  EXPECT_DOUBLE_EQ(light.error * 1024, heavy.error);
}

TEST(PaletteCodebook, OppositePointsAndPointsOnACircle) {
  std::vector<Vec3f> normals;
  for (int i = 0; i < 360; i++) normals.push_back(Vec3f(Vec3d{std::cos(radians(i)), std::sin(radians(i)), 0}));
  for (const int n : {2, 3, 5, 36}) {
    const Groups groups{testing::weighted(normals)};
    const Codebook book = fit_codebook(groups, n);
    ASSERT_EQ(book.size(), n);
    expect_unit(book);
    // Equal arcs: half a step of 360°/n, over √3.
    EXPECT_LT(rms_deg(groups[0], book.groups[0]), 1.1 * 180.0 / n / std::sqrt(3.0)) << n;
  }
  const Codebook poles = fit_codebook(Groups{{{{0, 0, 1}, 1}, {{0, 0, -1}, 1}, {{1, 0, 0}, 1}, {{-1, 0, 0}, 1}}}, 2);
  EXPECT_EQ(poles.size(), 2);
  expect_unit(poles);
}

TEST(PaletteCodebook, GroupsShareTheEntriesByNeed) {
  Random random(6);
  Groups groups(3);
  for (int i = 0; i < 3000; i++) {
    groups[0].push_back({random.in_cap(2), 1});
    groups[1].push_back({random.in_cap(60), 1});
    if (i < 30) groups[2].push_back({random.in_cap(60), 1});
  }
  const Codebook book = fit_codebook(groups, 128);
  ASSERT_EQ(book.groups.size(), 3u);
  EXPECT_EQ(book.size(), 128);
  expect_unit(book);
  EXPECT_GT(book.groups[1].size(), 5 * book.groups[0].size());
  EXPECT_GT(book.groups[1].size(), book.groups[2].size());
  const std::vector<int> share = share_entries(groups, 128);
  ASSERT_EQ(share.size(), 3u);
  EXPECT_EQ(share[0] + share[1] + share[2], 128);
  for (int s : share) EXPECT_GE(s, 1);
  EXPECT_GT(share[1], 5 * share[0]);
}

TEST(PaletteCodebook, EveryGroupHasEntriesOfItsOwn) {
  Groups groups;
  Random random(7);
  for (int g = 0; g < 6; g++) {
    // Around different axes, so that an entry of another group would be far off.
    const Vec3f axis = random.direction();
    groups.emplace_back();
    for (int i = 0; i < 200; i++)
      groups.back().push_back(
          {Vec3f(normalized(Vec3d(axis) + Vec3d(random.direction()) * 0.1)), float(1 + 999 * (g == 2))});
  }
  for (const int n : {6, 7, 20, 100}) {
    const Codebook book = fit_codebook(groups, n);
    ASSERT_EQ(book.groups.size(), 6u);
    EXPECT_EQ(book.size(), n);
    for (int g = 0; g < 6; g++) {
      ASSERT_FALSE(book.groups[g].empty()) << "group " << g << " of " << n;
      for (const Vec3f& e : book.groups[g])
        EXPECT_LT(testing::angle_deg(e, groups[g][0].normal), 13) << "group " << g << " of " << n;
    }
    EXPECT_NEAR(book.error, total_error(groups, book), 2e-3 * book.error) << n;
  }
}

TEST(PaletteCodebook, MovingAnEntryBetweenGroupsDoesNotPay) {
  Random random(8);
  Groups groups(2);
  for (int i = 0; i < 1500; i++) {
    groups[0].push_back({random.in_cap(12), 1});
    groups[1].push_back({random.in_cap(50), 1});
  }
  const Codebook book = fit_codebook(groups, 48);
  const int a = int(book.groups[0].size()), b = int(book.groups[1].size());
  ASSERT_EQ(a + b, 48);
  const auto alone = [&](int g, int n) { return fit_codebook(std::span(groups).subspan(g, 1), n).error; };
  for (const int moved : {-3, -2, -1, 1, 2, 3}) {
    if (a + moved < 1 || b - moved < 1) continue;
    EXPECT_LT(book.error, 1.01 * (alone(0, a + moved) + alone(1, b - moved)))
        << a << " and " << b << ", moved " << moved;
  }
}

TEST(PaletteCodebook, FewerEntriesThanGroupsIsRefused) {
  const Groups groups(3, std::vector<WeightedNormal>{{{0, 0, 1}, 1}, {{1, 0, 0}, 1}});
  EXPECT_ERROR(fit_codebook(groups, 2), ErrorKind::kMalformed, "3 materials");
  EXPECT_ERROR(share_entries(groups, 2), ErrorKind::kMalformed, "3 materials");
  EXPECT_EQ(fit_codebook(groups, 3).size(), 3);
  EXPECT_EQ(fit_codebook(groups, 6).size(), 6);
  EXPECT_EQ(fit_codebook(groups, 7).size(), 6);
}

TEST(PaletteCodebook, TheSameForAnyNumberOfThreads) {
  const Groups groups{clustered(20000, 9), clustered(9000, 10)};
  for (const int n : {5, 200, 3000}) {
    Codebook books[2];
    for (int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      books[threads - 1] = fit_codebook(groups, n);
    }
    EXPECT_EQ(books[0].groups, books[1].groups) << n;
    EXPECT_EQ(books[0].error, books[1].error) << n;
  }
}

TEST(PaletteCodebook, ProgressNeverFalls) {
  double last = 0;
  fit_codebook(Groups{clustered(3000, 11)}, 64, [&](double f) {
    EXPECT_GE(f, last);
    EXPECT_LE(f, 1);
    last = f;
  });
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace burnish
