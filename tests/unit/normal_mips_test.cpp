#include "burnish/normal/normal_mips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "expect_error.h"
#include "normal_mips_fixture.h"
#include "on_threads.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::Levels, testing::made, testing::random_normals, testing::ScratchDir;

std::vector<Image> means_of(const Image& normals) {
  const ScratchDir dir;
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, normals);
  NormalMips mips(dir / "n.exr", {}, 0);
  return made(mips).means;
}

std::vector<Image> alphas_of(const Image& normals, const Image& alpha) {
  const ScratchDir dir;
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, normals);
  write_image(dir / "a.exr", FileType::kExr, SampleType::kFloat, alpha);
  NormalMips mips(dir / "n.exr", {}, 0);
  mips.add_roughness("roughness", {0, dir / "a.exr"});
  return made(mips).alphas;
}

struct EncodedNormals {
  Image image;
  double rms_deg;
};
EncodedNormals encoded_level(const Image& means, const NormalCoding& coding, SampleType sample) {
  NormalLevelEncoder encoder(coding, sample);
  Image image = encoder.encode(means);
  return {std::move(image), encoder.rms_deg()};
}

Vec3d vector_at(const Image& image, int x, int y) {
  const float* t = image.at(x, y);
  return {t[0], t[1], t[2]};
}

TEST(MipAverage, IsTheWeightedMeanOfEachChannel) {
  Image finer(3, 2, 2);
  finer.data = {1, 10, 2, 20, 4, 40, 3, 30, 6, 60, 8, 80};
  const Image coarse = next_mean_level(finer);
  EXPECT_EQ(coarse.width, 1);
  EXPECT_EQ(coarse.height, 1);
  EXPECT_FLOAT_EQ(coarse.data[0], 4);
  EXPECT_FLOAT_EQ(coarse.data[1], 40);
}

// However rows come, each level's rows are those of the whole level above.
TEST(MeanCascade, IsNextMeanLevelByRows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1, 1);
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {127, 65}, {64, 32}, {1, 9}, {9, 1}, {3, 255}})
    for (const int at_once : {1, 2, 3, 7, 64, 1000}) {
      Image base(width, height, 2);
      for (float& v : base.data) v = value(random);
      const int count = level_count(width, height);
      std::vector<std::vector<float>> rows(count);
      MeanCascade cascade(width, height, 2, count, [&](int l, int first, int rows_now, const float* from) {
        const std::size_t row_size = std::size_t(level_size(width, l)) * 2;
        EXPECT_EQ(rows[l].size(), first * row_size);
        rows[l].insert(rows[l].end(), from, from + rows_now * row_size);
      });
      for (int y = 0; y < height; y += at_once) cascade.add(std::min(at_once, height - y), base.row(y));
      Image level = base;
      for (int l = 0; l < count; l++) {
        EXPECT_EQ(rows[l], level.data) << width << "x" << height << ", " << at_once << " at once, level " << l;
        level = next_mean_level(level);
      }
    }
}

// Of a power of two a level is the plain mean of blocks; of odd sizes the coarsest is the mean of all.
TEST(NormalMips, LevelsAreMeansOfTheBase) {
  const Image base = random_normals(16, 8);
  const std::vector<Image> means = means_of(base);
  ASSERT_EQ(means.size(), 5u);
  Vec3d sum;
  for (int y = 4; y < 8; y++)
    for (int x = 8; x < 12; x++) sum += vector_at(base, x, y) / 16.0;
  EXPECT_NEAR(length(vector_at(means[2], 2, 1) - sum), 0, 1e-6);
  for (const auto& [width, height] : {std::pair{7, 5}, {1, 9}, {13, 2}}) {
    const Image odd = random_normals(width, height);
    Vec3d mean;
    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++) mean += vector_at(odd, x, y) / double(odd.texels());
    EXPECT_NEAR(length(vector_at(means_of(odd).back(), 0, 0) - mean), 0, 1e-6) << width << "x" << height;
  }
}

TEST(NormalMips, EncodedLevelsAreUnitVectorsAndSayWhatStoringCosts) {
  const std::vector<Image> means = means_of(random_normals(8, 8));
  for (const GreenAxis green : {GreenAxis::kUp, GreenAxis::kDown})
    for (int l : {0, 2}) {
      NormalCoding coding;
      coding.green = green;
      const EncodedNormals exact = encoded_level(means[l], coding, SampleType::kFloat);
      Vec3d mean = normalized(vector_at(means[l], 1, 0));
      if (green == GreenAxis::kDown) mean.y = -mean.y;
      EXPECT_NEAR(length(vector_at(exact.image, 1, 0) - mean), 0, 1e-6);
      EXPECT_LT(exact.rms_deg, 1e-5);
      // A step of 1/255 in three biased components: √(3/12)·2/255 rad for the vector, less along it.
      const EncodedNormals bytes = encoded_level(means[l], coding, SampleType::kUint8);
      EXPECT_GT(bytes.rms_deg, 0.1);
      EXPECT_LT(bytes.rms_deg, 0.3);
      EXPECT_GE(*std::ranges::min_element(bytes.image.data), 0);
    }
}

TEST(NormalMips, NormalsThatCancelOutPointUp) {
  Image base(2, 1, 3);
  base.data = {1, 0, 0, -1, 0, 0};
  const EncodedNormals top = encoded_level(means_of(base)[1], {}, SampleType::kFloat);
  EXPECT_EQ(top.image.data, (std::vector<float>{0, 0, 1}));
}

TEST(NormalMips, RoughnessGainsTheVarianceOfTheNormals) {
  // ±θ about v: ‖m‖ = cos θ.
  const float s = 0.6f, c = 0.8f;
  Image base(2, 2, 3);
  base.data = {s, 0, c, -s, 0, c, s, 0, c, -s, 0, c};
  Image alpha(2, 2);
  alpha.data = {0.1f, 0.2f, 0.3f, 0.4f};
  const std::vector<Image> levels = alphas_of(base, alpha);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].data, alpha.data);
  EXPECT_NEAR(levels[1].data[0], std::sqrt(0.075 + 2 * (1 - 0.8) / 0.8), 1e-6);
}

TEST(NormalMips, AFlatMapKeepsItsRoughness) {
  Image base(9, 6, 3), alpha(9, 6);
  for (std::size_t i = 0; i < base.texels(); i++) base.data[3 * i + 2] = 1, alpha.data[i] = 0.2f;
  for (const Image& level : alphas_of(base, alpha))
    for (const float v : level.data) EXPECT_NEAR(v, 0.2f, 1e-6);
}

// For small slopes α² grows by twice their variance, as LEAN mapping has it.
TEST(NormalMips, RoughnessIsLeanMappingsForSmallSlopes) {
  std::mt19937 random(3);
  std::normal_distribution<float> slope(0, 0.05f);
  Image base(64, 64, 3), alpha(64, 64);
  for (std::size_t i = 0; i < base.texels(); i++) {
    const Vec3f n = normalized(Vec3f{slope(random), slope(random), 1});
    std::copy_n(&n.x, 3, &base.data[3 * i]);
    alpha.data[i] = 0.1f;
  }
  const float got = alphas_of(base, alpha).back().data[0];
  EXPECT_NEAR(got * got, 0.01 + 2 * 0.05 * 0.05, 2e-4);
}

TEST(NormalMips, RoughnessAsANumberOrAMap) {
  const ScratchDir dir;
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, random_normals(4, 3));
  Image alpha(4, 3);
  const auto write = [&] { write_image(dir / "a.exr", FileType::kExr, SampleType::kFloat, alpha); };
  const auto read = [&](const ParameterSource& source) {
    NormalMips mips(dir / "n.exr", {}, 0);
    mips.add_roughness("roughness", source);
    return made(mips).alphas[0];
  };
  const ParameterSource map{0, dir / "a.exr"};
  write();
  EXPECT_EQ(read(map).data, alpha.data);
  EXPECT_EQ(read({0.25, {}}).data, std::vector<float>(12, 0.25f));
  EXPECT_ERROR(read({-1, {}}), ErrorKind::kUsage, "roughness: expected alpha of at least 0");
  for (const float bad : {-0.1f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    alpha.data[6] = bad;
    write();
    EXPECT_ERROR(read(map), ErrorKind::kMalformed, "at column 2, row 1");
  }
  alpha = Image(3, 4);
  write();
  EXPECT_ERROR(read(map), ErrorKind::kMalformed, "expected 4x3 texels");
}

TEST(NormalMips, SpaceInvalidTexelsAndLevels) {
  const ScratchDir dir;
  Image base = random_normals(4, 4);
  std::fill_n(base.at(1, 2), 3, 0.f);
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, base, space_attributes(NormalSpace::kObject));
  NormalMips mips(dir / "n.exr", {}, 2);
  EXPECT_EQ(mips.levels(), 2);
  EXPECT_EQ(made(mips).means.size(), 2u);
  EXPECT_EQ(mips.space(), NormalSpace::kObject);
  EXPECT_EQ(mips.invalid_texels(), 1u);
  EXPECT_ERROR(NormalMips(dir / "n.exr", {}, 4), ErrorKind::kUsage, "levels: expected 1 to 3");
}

TEST(NormalMips, TheSameForAnyThreadCount) {
  const Image base = random_normals(131, 97);
  const auto top = [&] { return means_of(base).back().data; };
  EXPECT_EQ(on_threads(1, top), on_threads(4, top));
}

}  // namespace
}  // namespace burnish
