#include <gtest/gtest.h>

#include <map>

#include "burnish/core/parallel.h"
#include "burnish/palette/histogram.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::Random;
using testing::ScratchDir;

Histogram count(std::vector<MapFiles> files) {
  MapSet maps(std::move(files), {});
  return count_normals(maps);
}
Histogram count(const std::string& file) { return count({MapFiles{file}}); }

double weight_of(const std::vector<WeightedNormal>& group, Vec3f n) {
  double weight = 0;
  for (const WeightedNormal& p : group)
    if (testing::angle_deg(p.normal, n) < 0.1) weight += p.weight;
  return weight;
}

const std::vector<Vec3f>& few() {
  // A grid of 16 bits holds these to 1e-5, halves to 3e-4.
  static const std::vector<Vec3f> normals{
      {0, 0, 1}, {0.6f, 0, 0.8f}, {0, -0.6f, 0.8f}, {0.48f, 0.64f, 0.6f}, {-1, 0, 0}};
  return normals;
}

struct Stored {
  const char* file;
  SampleType sample;
};
const Stored kStored[] = {{"n.png", SampleType::kUint8},  {"n.tga", SampleType::kUint8}, {"n.png", SampleType::kUint16},
                          {"n.tif", SampleType::kUint16}, {"n.exr", SampleType::kHalf},  {"n.exr", SampleType::kFloat},
                          {"n.tif", SampleType::kFloat}};

TEST(PaletteHistogram, CountsAreExactInEverySampleType) {
  const ScratchDir dir;
  Random random(1);
  const int width = 61, height = 530;  // more than two bands of rows
  std::vector<Vec3f> normals;
  std::vector<int> expected(few().size());
  for (int i = 0; i < width * height; i++) {
    const int k = random.below(random.below(5) + 1);
    expected[k]++, normals.push_back(few()[k]);
  }
  for (const Stored& s : kStored) {
    testing::write_normals(dir / s.file, s.sample, width, height, normals);
    const Histogram h = count(dir / s.file);
    EXPECT_TRUE(h.exact);
    EXPECT_EQ(h.maps[0].counted, normals.size());
    EXPECT_EQ(h.distinct, few().size()) << s.file << " " << name(s.sample);
    EXPECT_EQ(h.maps[0].invalid, 0u);
    ASSERT_EQ(h.material, std::vector<int>{0});
    ASSERT_EQ(h.groups[0].size(), few().size());
    for (std::size_t k = 0; k < few().size(); k++) {
      double nearest = 180, weight = 0;
      for (const WeightedNormal& p : h.groups[0])
        if (const double a = testing::angle_deg(p.normal, few()[k]); a < nearest) nearest = a, weight = p.weight;
      EXPECT_LT(nearest, 0.5) << s.file << " " << name(s.sample);
      EXPECT_EQ(weight, expected[k]) << s.file << " " << name(s.sample);
    }
  }
}

TEST(PaletteHistogram, MaterialsAndMasks) {
  const ScratchDir dir;
  const int width = 8, height = 4;
  std::vector<Vec3f> normals;
  std::vector<int> ids, mask;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      normals.push_back(few()[x % 2]);
      ids.push_back(x < 4 ? 9 : x < 6 ? 200 : 31);
      mask.push_back(x < 6 && y > 0 ? 255 : 0);
    }
  testing::write_normals(dir / "n.exr", SampleType::kFloat, width, height, normals);
  testing::write_ids(dir / "ids.png", width, height, ids);
  testing::write_ids(dir / "mask.png", width, height, mask);
  const Histogram h = count({MapFiles{dir / "n.exr", dir / "ids.png", dir / "mask.png"}});
  EXPECT_EQ(h.material, (std::vector<int>{9, 31, 200}));
  EXPECT_EQ(h.maps[0].counted, 18u);
  EXPECT_EQ(h.distinct, 4u);
  ASSERT_EQ(h.groups.size(), 3u);
  EXPECT_EQ(weight_of(h.groups[0], few()[0]), 6);
  EXPECT_EQ(weight_of(h.groups[0], few()[1]), 6);
  EXPECT_EQ(weight_of(h.groups[2], few()[0]), 3);
  // Masked out whole, and yet in need of an entry.
  ASSERT_EQ(h.groups[1].size(), 1u);
  EXPECT_LT(testing::angle_deg(h.groups[1][0].normal, few()[0] + few()[1]), 1e-4);
}

TEST(PaletteHistogram, WhatIsMaskedOutShapesNothing) {
  const ScratchDir dir;
  std::vector<Vec3f> normals(100, few()[1]);
  std::vector<int> mask(100);
  for (int i = 0; i < 100; i++)
    if (i % 3 == 0) normals[i] = Vec3f(normalized(Vec3d{double(i), 1, 5}));
    else mask[i] = 1;
  testing::write_normals(dir / "n.tif", SampleType::kUint16, 10, 10, normals);
  testing::write_ids(dir / "mask.png", 10, 10, mask);
  const Histogram h = count({MapFiles{dir / "n.tif", {}, dir / "mask.png"}});
  EXPECT_EQ(h.maps[0].counted, 66u);
  EXPECT_EQ(h.distinct, 1u);
  ASSERT_EQ(h.groups[0].size(), 1u);
  EXPECT_EQ(h.groups[0][0].weight, 66);
}

TEST(PaletteHistogram, DifferentCodesOfOneNormalAreOne) {
  const ScratchDir dir;
  Image image(4, 1, 3);  // lengths 1, 2 and 4: halves of other bits and the same direction
  image.data = {0, 0.5f, 0.5f, 0, 1, 1, 0, 2, 2, -0.f, 0.5f, 0.5f};
  for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
    write_image(dir / "n.exr", FileType::kExr, sample, image);
    const Histogram h = count(dir / "n.exr");
    EXPECT_EQ(h.distinct, 1u) << name(sample);
    ASSERT_EQ(h.groups[0].size(), 1u);
    EXPECT_EQ(h.groups[0][0].weight, 4);
  }
}

TEST(PaletteHistogram, VectorsWithoutADirectionAreCounted) {
  const ScratchDir dir;
  Image image(4, 1, 3);
  image.data = {0, 0, 0, 1e-4f, 0, 0, 0, 0, 1, 0, 1, 0};
  for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
    write_image(dir / "n.exr", FileType::kExr, sample, image);
    const Histogram h = count(dir / "n.exr");
    EXPECT_EQ(h.maps[0].invalid, 2u) << name(sample);
    EXPECT_EQ(h.distinct, 2u) << name(sample);
    EXPECT_EQ(weight_of(h.groups[0], {0, 0, 1}), 3) << name(sample);
  }
}

TEST(PaletteHistogram, TooManyNormalsAreCountedInBins) {
  const ScratchDir dir;
  const int width = 2048, height = 1100;
  Random random(2);
  const std::vector<Vec3f> normals = random.directions(std::size_t(width) * height);
  testing::write_normals(dir / "n.exr", SampleType::kFloat, width, height, normals);
  Histogram histograms[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    histograms[threads - 1] = count(dir / "n.exr");
  }
  const Histogram& h = histograms[0];
  EXPECT_FALSE(h.exact);
  EXPECT_EQ(h.maps[0].counted, normals.size());
  ASSERT_EQ(h.groups.size(), 1u);
  EXPECT_EQ(h.distinct, h.groups[0].size());
  EXPECT_LE(h.distinct, std::size_t(1) << 20);
  EXPECT_GT(h.distinct, std::size_t(1) << 18);
  double weight = 0;
  Vec3d sum, expected;
  for (const WeightedNormal& p : h.groups[0]) {
    ASSERT_NEAR(length(Vec3d(p.normal)), 1, 1e-6);
    weight += p.weight, sum += Vec3d(p.normal) * double(p.weight);
  }
  for (const Vec3f& n : normals) expected += Vec3d(n);
  EXPECT_EQ(weight, double(normals.size()));
  EXPECT_LT(length(sum - expected) / double(normals.size()), 1e-5);

  const Histogram& two = histograms[1];
  ASSERT_EQ(two.groups[0].size(), h.groups[0].size());
  for (std::size_t i = 0; i < h.groups[0].size(); i++) {
    ASSERT_EQ(two.groups[0][i].normal, h.groups[0][i].normal) << i;
    ASSERT_EQ(two.groups[0][i].weight, h.groups[0][i].weight) << i;
  }
}

TEST(PaletteHistogram, TheSameForAnyNumberOfThreads) {
  const ScratchDir dir;
  testing::write_normals(dir / "n.png", SampleType::kUint8, 300, 700, testing::bumpy_normals(300, 700));
  Histogram histograms[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    histograms[threads - 1] = count(dir / "n.png");
  }
  ASSERT_EQ(histograms[0].groups[0].size(), histograms[1].groups[0].size());
  for (std::size_t i = 0; i < histograms[0].groups[0].size(); i++) {
    ASSERT_EQ(histograms[0].groups[0][i].normal, histograms[1].groups[0][i].normal);
    ASSERT_EQ(histograms[0].groups[0][i].weight, histograms[1].groups[0][i].weight);
  }
}

}  // namespace
}  // namespace burnish
