#include <gtest/gtest.h>

#include "burnish/core/parallel.h"
#include "burnish/palette/nearest_entry.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::brute_nearest;
using testing::Random;

// An entry finds itself, wherever rounding puts it behind another.
int brute_itself_or_nearest(const std::vector<Vec3f>& entries, Vec3f v) {
  const auto itself = std::ranges::find(entries, v);
  return itself != entries.end() ? int(itself - entries.begin()) : brute_nearest(entries, v);
}

enum class Spread { kSphere, kCap, kGreatCircle, kDuplicates, kAxes };

std::vector<Vec3f> make_palette(Spread spread, int n, Random& random) {
  std::vector<Vec3f> out;
  for (int i = 0; i < n; i++) switch (spread) {
      case Spread::kSphere:
        out.push_back(random.direction());
        break;
      case Spread::kCap:
        out.push_back(random.in_cap(5));
        break;
      case Spread::kGreatCircle: {
        const double a = 2 * kPi * random.unit();
        out.push_back(Vec3f(normalized(Vec3d{std::cos(a), 0.6 * std::sin(a), 0.8 * std::sin(a)})));
        break;
      }
      case Spread::kDuplicates:
        out.push_back(i < 3 ? random.direction() : out[random.below(i)]);
        break;
      case Spread::kAxes: {
        Vec3f v{};
        const float s = random.below(2) ? 1.f : -1.f;
        switch (random.below(3)) {
          case 0:
            v.x = s;
            break;
          case 1:
            v.y = s;
            break;
          default:
            v.z = s;
        }
        out.push_back(v);
      }
    }
  return out;
}

// Queries near and far from the entries, on axes, edges and corners of the cube, of lengths from 1e-6 to 1e6.
std::vector<Vec3f> make_queries(const std::vector<Vec3f>& entries, int n, Random& random) {
  std::vector<Vec3f> out;
  for (float x : {-1.f, 0.f, 1.f})
    for (float y : {-1.f, 0.f, 1.f})
      for (float z : {-1.f, 0.f, 1.f})
        if (x != 0 || y != 0 || z != 0) out.push_back({x, y, z});
  for (int i = 0; i < n; i++) {
    const Vec3f entry = entries[random.below(int(entries.size()))];
    const Vec3f v = i % 3 == 0   ? random.direction()
                    : i % 3 == 1 ? entry
                                 : entry + random.direction() * float(std::pow(10.0, -4 * random.unit()));
    out.push_back(v * float(std::pow(10.0, 12 * random.unit() - 6)));
  }
  return out;
}

TEST(PaletteNearestEntry, FindsWhatBruteForceFinds) {
  Random random(11);
  for (const Spread spread : {Spread::kSphere, Spread::kCap, Spread::kGreatCircle, Spread::kDuplicates, Spread::kAxes})
    for (const int n : {1, 2, 17, 256, 5000, 65536}) {
      const std::vector<Vec3f> entries = make_palette(spread, n, random);
      const NearestEntry nearest(entries);
      for (const Vec3f& v : make_queries(entries, n > 5000 ? 150 : 1500, random)) {
        const int found = nearest(v), expected = brute_itself_or_nearest(entries, v);
        ASSERT_EQ(found, expected) << "spread " << int(spread) << ", " << n << " entries, query " << v.x << " " << v.y
                                   << " " << v.z << ": dot " << dot(v, entries[found]) << " against "
                                   << dot(v, entries[expected]);
      }
    }
}

TEST(PaletteNearestEntry, AnEntryFindsItselfOrItsFirstDouble) {
  Random random(3);
  std::vector<Vec3f> entries = random.directions(3000);
  for (int i = 0; i < 500; i++) entries.push_back(entries[random.below(3000)]);
  const NearestEntry nearest(entries);
  for (std::size_t i = 0; i < entries.size(); i++)
    ASSERT_EQ(nearest(entries[i]), std::ranges::find(entries, entries[i]) - entries.begin()) << "entry " << i;
}

TEST(PaletteNearestEntry, ATieGoesToTheSmallerIndex) {
  const std::vector<Vec3f> entries{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {-1, 0, 0}};
  const NearestEntry nearest(entries);
  EXPECT_EQ(nearest({0, 0, 1}), 1);  // four at 90°
  EXPECT_EQ(nearest({1, 1, 0}), 1);
  EXPECT_EQ(nearest({1, -1, 0}), 2);
  EXPECT_EQ(nearest({-1, -1, 0}), 3);
  EXPECT_EQ(nearest({-1, 0, -1}), 0);
  const NearestEntry same(std::vector<Vec3f>(100, Vec3f{0.6f, 0, 0.8f}));
  EXPECT_EQ(same({0.6f, 0, 0.8f}), 0);
  EXPECT_EQ(same({-1, 2, -3}), 0);
}

// A flat float map with noise in its last bits makes such palettes; a division of cells must not go on for
// entries that no direction tells apart.
TEST(PaletteNearestEntry, EntriesAsCloseAsFloatsCanBe) {
  Random random(9);
  for (const double spread : {1e-3, 1e-5, 1e-6, 1e-7}) {
    std::vector<Vec3f> entries;
    for (int i = 0; i < 300; i++)
      entries.push_back(Vec3f(normalized(Vec3d{0.36, 0.48, 0.8} + Vec3d(random.direction()) * spread)));
    const NearestEntry nearest(entries);
    for (int i = 0; i < 3000; i++) {
      const Vec3f v = i % 2 ? random.direction() : entries[random.below(300)];
      ASSERT_EQ(nearest(v), brute_itself_or_nearest(entries, v))
          << "spread " << spread << ", query " << v.x << " " << v.y << " " << v.z;
    }
  }
}

TEST(PaletteNearestEntry, TheSameForAnyNumberOfThreads) {
  Random random(5);
  const std::vector<Vec3f> entries = random.directions(4096), queries = random.directions(20000);
  std::vector<int> found[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const NearestEntry nearest(entries);
    for (const Vec3f& v : queries) found[threads - 1].push_back(nearest(v));
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace burnish
