#include <gtest/gtest.h>

#include "burnish/core/parallel.h"
#include "burnish/palette/index_mips.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::angle_deg;
using testing::Random;
using testing::random_map;
using testing::ScratchDir;

struct Vectors {
  int width, height;
  std::vector<Vec3d> at;
};

Vectors decoded(const Palette& palette, const IndexImage& level) {
  Vectors v{level.width, level.height, {}};
  for (const std::uint16_t i : level.data) v.at.push_back(Vec3d(palette.normals[i]));
  return v;
}

// Weighted means, not renormalised, with the overlap of intervals for weights: texel i of m covers [i·n/m, (i
// + 1)·n/m) of n. The taps of core/mip.h are held against this in mip_test.cpp; here they are taken as given.
Vectors coarser(const Vectors& v) {
  Vectors out{next_level_size(v.width), next_level_size(v.height), {}};
  for (int y = 0; y < out.height; y++)
    for (int x = 0; x < out.width; x++) {
      const MipTaps ty = mip_taps(v.height, y), tx = mip_taps(v.width, x);
      Vec3d sum;
      for (int j = 0; j < ty.count; j++)
        for (int i = 0; i < tx.count; i++)
          sum += v.at[std::size_t(ty.first + j) * v.width + tx.first + i] * double(ty.weight[j] * tx.weight[i]);
      out.at.push_back(sum / double(ty.total * tx.total));
    }
  return out;
}

struct Wanted {
  int material = -1;  // position
  Vec3d sum;
};

// The majority material below a texel and the sum of its normals.
Wanted majority(const IndexedMap& map, const IndexImage& finer, int x, int y) {
  const MipTaps ty = mip_taps(finer.height, y), tx = mip_taps(finer.width, x);
  std::vector<int> weight(map.palette.materials.size());
  std::vector<Vec3d> sum(weight.size());
  for (int j = 0; j < ty.count; j++)
    for (int i = 0; i < tx.count; i++) {
      const int index = *finer.at(tx.first + i, ty.first + j), w = ty.weight[j] * tx.weight[i];
      for (std::size_t m = 0; m < weight.size(); m++) {
        const MaterialInterval& interval = map.palette.materials[m];
        if (index < interval.first || index >= interval.first + interval.count) continue;
        weight[m] += w;
        sum[m] += Vec3d(map.palette.normals[index]) * double(w);
      }
    }
  Wanted best;
  for (std::size_t m = 0; m < weight.size(); m++) {
    if (best.material >= 0) {
      const int b = best.material;
      const double lm = dot(sum[m], sum[m]), lb = dot(best.sum, best.sum);
      if (weight[m] < weight[b]) continue;
      if (weight[m] == weight[b] &&
          (lm < lb || (lm == lb && map.palette.materials[m].id > map.palette.materials[b].id)))
        continue;
    }
    best = {int(m), sum[m]};
  }
  return best;
}

// Every texel of a level is the best entry of the wanted material for a vector.
void expect_best(const IndexedMap& map, int l, int x, int y, const Wanted& wanted) {
  const MaterialInterval& interval = map.palette.materials[wanted.material];
  const int index = *map.levels[l].at(x, y);
  ASSERT_GE(index, interval.first) << "level " << l << " column " << x << " row " << y;
  ASSERT_LT(index, interval.first + interval.count) << "level " << l << " column " << x << " row " << y;
  const double size = length(wanted.sum);
  if (size < 1e-5) return;
  double most = -2;
  for (int i = interval.first; i < interval.first + interval.count; i++)
    most = std::max(most, dot(Vec3d(map.palette.normals[i]), wanted.sum) / size);
  EXPECT_NEAR(dot(Vec3d(map.palette.normals[index]), wanted.sum) / size, most, 1e-6)
      << "level " << l << " column " << x << " row " << y;
}

const int kSizes[][2] = {{64, 64}, {32, 16}, {333, 77}, {1, 37}, {37, 1}, {5, 3}, {3, 3}, {2, 1}, {1, 1}};

TEST(PaletteIndexMips, EveryTexelIsTheBestEntryForThoseBelow) {
  for (const int materials : {1, 5})
    for (const auto& [width, height] : kSizes) {
      IndexedMap map = random_map(width, height, 120, materials);
      const std::vector<MipLevelStats> stats = build_index_mips(map, {});
      ASSERT_EQ(int(map.levels.size()), level_count(width, height));
      ASSERT_EQ(stats.size(), map.levels.size());
      for (std::size_t l = 1; l < map.levels.size(); l++) {
        const IndexImage& level = map.levels[l];
        ASSERT_EQ(level.width, next_level_size(map.levels[l - 1].width));
        ASSERT_EQ(level.height, next_level_size(map.levels[l - 1].height));
        ASSERT_EQ(stats[l].width, level.width);
        ASSERT_EQ(stats[l].height, level.height);
        for (int y = 0; y < level.height; y++)
          for (int x = 0; x < level.width; x++) expect_best(map, int(l), x, y, majority(map, map.levels[l - 1], x, y));
      }
    }
}

TEST(PaletteIndexMips, StatsAreTheAnglesToTheMeanOfTheBase) {
  for (const auto& [width, height] : kSizes) {
    IndexedMap map = random_map(width, height, 60, 2);
    const Vectors base = decoded(map.palette, map.levels[0]);
    const std::vector<MipLevelStats> stats = build_index_mips(map, {});
    EXPECT_EQ(stats[0].rms_deg, 0);
    Vectors truth = base;
    for (std::size_t l = 1; l < map.levels.size(); l++) {
      truth = coarser(truth);
      double squares = 0;
      int texels = 0;
      for (std::size_t i = 0; i < truth.at.size(); i++) {
        if (length(truth.at[i]) < 1e-6) continue;
        const double a = degrees(angle_rad(truth.at[i], Vec3d(map.palette.normals[map.levels[l].data[i]])));
        squares += a * a, texels++;
      }
      EXPECT_NEAR(stats[l].rms_deg, texels ? std::sqrt(squares / texels) : 0, 2e-3)
          << width << "x" << height << " level " << l;
    }
  }
}

// Smooth normals, where every level means something.
IndexedMap smooth_map(int width, int height, int entries, std::vector<Vec3f>* normals) {
  *normals = testing::bumpy_normals(width, height, 3);
  IndexedMap map;
  for (const Vec3f& v : testing::fibonacci_sphere(2 * entries))
    if (v.z > 0) map.palette.normals.push_back(v);
  map.palette.materials = {{0, 0, int(map.palette.normals.size())}};
  map.levels.emplace_back(width, height);
  for (std::size_t i = 0; i < normals->size(); i++)
    map.levels[0].data[i] = std::uint16_t(testing::brute_nearest(map.palette.normals, (*normals)[i]));
  return map;
}

TEST(PaletteIndexMips, FromTheBaseAndFromTheSource) {
  const ScratchDir dir;
  for (const auto& [width, height] : {std::pair(128, 96), std::pair(101, 59)}) {
    std::vector<Vec3f> normals;
    IndexedMap map = smooth_map(width, height, 100, &normals);
    testing::write_normals(dir / "n.exr", SampleType::kFloat, width, height, normals);
    std::vector<MipLevelStats> by_level = build_index_mips(map, {});
    const IndexedMap from_level = map;

    IndexMipOptions base_options;
    base_options.average = MipAverage::kBase;
    const std::vector<MipLevelStats> by_base = build_index_mips(map, base_options);
    Vectors truth = decoded(map.palette, map.levels[0]);
    for (std::size_t l = 1; l < map.levels.size(); l++) {
      truth = coarser(truth);
      for (int i = 0; i < int(truth.at.size()); i++)
        expect_best(map, int(l), i % truth.width, i / truth.width, {0, truth.at[i]});
      EXPECT_LE(by_base[l].rms_deg, by_level[l].rms_deg + 1e-4) << "level " << l;
    }

    IndexMipOptions source_options;
    source_options.source = dir / "n.exr";
    const std::vector<MipLevelStats> by_source = build_index_mips(map, source_options);
    Vectors mean{width, height, {}};
    double squares = 0;
    for (std::size_t i = 0; i < normals.size(); i++) {
      mean.at.push_back(Vec3d(normals[i]));
      squares += std::pow(angle_deg(normals[i], map.palette.normals[map.levels[0].data[i]]), 2);
    }
    EXPECT_NEAR(by_source[0].rms_deg, std::sqrt(squares / double(normals.size())), 1e-4);
    for (std::size_t l = 1; l < map.levels.size(); l++) {
      mean = coarser(mean);
      double from_source_squares = 0, from_level_squares = 0;
      for (int i = 0; i < int(mean.at.size()); i++) {
        expect_best(map, int(l), i % mean.width, i / mean.width, {0, mean.at[i]});
        const auto off = [&](const IndexedMap& m) {
          return degrees(angle_rad(mean.at[i], Vec3d(m.palette.normals[m.levels[l].data[i]])));
        };
        from_source_squares += std::pow(off(map), 2), from_level_squares += std::pow(off(from_level), 2);
      }
      EXPECT_LE(from_source_squares, from_level_squares + 1e-6) << "level " << l;
      EXPECT_NEAR(by_source[l].rms_deg, std::sqrt(from_source_squares / double(mean.at.size())), 1e-3) << "level " << l;
    }
  }
}

// Two texels of either material; ids in another order than the entries.
IndexedMap tie_map(const std::vector<Vec3f>& first, const std::vector<Vec3f>& second, int first_id, int second_id) {
  IndexedMap map;
  map.palette.normals = first;
  map.palette.normals.insert(map.palette.normals.end(), second.begin(), second.end());
  map.palette.materials = {{first_id, 0, int(first.size())}, {second_id, int(first.size()), int(second.size())}};
  map.levels.emplace_back(2, 2);
  const int a = int(first.size());
  map.levels[0].data = {0, std::uint16_t(a - 1), std::uint16_t(a), std::uint16_t(a + int(second.size()) - 1)};
  return map;
}

TEST(PaletteIndexMips, ATieGoesToTheLongerSumThenToTheSmallerId) {
  const Vec3f up{0, 0, 1}, left{-0.6f, 0, 0.8f}, right{0.6f, 0, 0.8f};
  struct Case {
    std::vector<Vec3f> first, second;
    int first_id, second_id, expected;  // position
  };
  for (const Case& c : {Case{{left, right}, {up}, 1, 2, 1}, Case{{up}, {left, right}, 1, 2, 0},
                        Case{{up}, {left, right}, 9, 2, 0}, Case{{up}, {up}, 1, 2, 0}, Case{{up}, {up}, 7, 2, 1},
                        Case{{left}, {right}, 7, 2, 1}, Case{{left}, {right}, 2, 7, 0}}) {
    IndexedMap map = tie_map(c.first, c.second, c.first_id, c.second_id);
    build_index_mips(map, {});
    EXPECT_EQ(map.palette.interval_of(map.levels[1].data[0]), c.expected)
        << "ids " << c.first_id << ", " << c.second_id;
  }
}

TEST(PaletteIndexMips, TheMajorityWinsHoweverShortItsSum) {
  IndexedMap map;
  map.palette.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  map.palette.materials = {{5, 0, 2}, {1, 2, 2}};
  map.levels.emplace_back(2, 2);
  map.levels[0].data = {2, 0, 0, 1};
  build_index_mips(map, {});
  EXPECT_EQ(map.levels[1].data[0], 0);
}

TEST(PaletteIndexMips, NormalsThatCancelOutGiveOneOfThem) {
  IndexedMap map;
  map.palette.normals = {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}};
  map.palette.materials = {{0, 0, 3}};
  for (const MipAverage average : {MipAverage::kLevel, MipAverage::kBase})
    for (const auto& [width, height] : {std::pair(2, 2), std::pair(8, 8), std::pair(4, 1), std::pair(6, 10)}) {
      map.levels.assign(1, IndexImage(width, height));
      for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) *map.levels[0].at(x, y) = std::uint16_t(1 + (x + y) % 2);
      IndexMipOptions options;
      options.average = average;
      const std::vector<MipLevelStats> stats = build_index_mips(map, options);
      for (std::size_t l = 1; l < map.levels.size(); l++) {
        for (const std::uint16_t i : map.levels[l].data) EXPECT_LT(i, 3);
        EXPECT_TRUE(std::isfinite(stats[l].rms_deg));
      }
      EXPECT_NE(map.levels[1].data[0], 0) << width << "x" << height;  // the entry across is not what lies below
    }
}

TEST(PaletteIndexMips, ANumberOfLevels) {
  IndexedMap map = random_map(16, 8, 10, 1);
  IndexMipOptions options;
  for (const int levels : {1, 2, 5}) {
    options.levels = levels;
    EXPECT_EQ(int(build_index_mips(map, options).size()), levels);
    EXPECT_EQ(int(map.levels.size()), levels);
  }
  for (const int levels : {-1, 6, 100}) {
    options.levels = levels;
    EXPECT_ERROR(build_index_mips(map, options), ErrorKind::kUsage, "levels: expected 1 to 5");
  }
}

TEST(PaletteIndexMips, ASourceOfAnotherSizeIsRefused) {
  const ScratchDir dir;
  testing::write_normals(dir / "n.png", SampleType::kUint8, 16, 9, testing::bumpy_normals(16, 9));
  IndexedMap map = random_map(16, 8, 10, 1);
  IndexMipOptions options;
  options.source = dir / "n.png";
  EXPECT_ERROR(build_index_mips(map, options), ErrorKind::kMalformed, "16x8");
}

TEST(PaletteIndexMips, TheSameForAnyNumberOfThreads) {
  for (const MipAverage average : {MipAverage::kLevel, MipAverage::kBase}) {
    IndexedMap maps[2];
    std::vector<MipLevelStats> stats[2];
    for (int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      maps[threads - 1] = random_map(300, 201, 500, 3);
      IndexMipOptions options;
      options.average = average;
      stats[threads - 1] = build_index_mips(maps[threads - 1], options);
    }
    for (std::size_t l = 0; l < maps[0].levels.size(); l++) {
      EXPECT_EQ(maps[0].levels[l].data, maps[1].levels[l].data) << "level " << l;
      EXPECT_EQ(stats[0][l].rms_deg, stats[1][l].rms_deg) << "level " << l;
    }
  }
}

}  // namespace
}  // namespace burnish
