#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "burnish/normal/coding.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

std::vector<Vec3f> read_all(const std::string& file, const NormalCoding& coding = {}) {
  int w, h;
  return read_normals(file, coding, &w, &h);
}

void write_samples(const std::string& file, SampleType sample, int w, int h, int channels, std::vector<float> samples) {
  Image image(w, h, channels);
  image.data = std::move(samples);
  write_image(file, file_type_of(file), sample, image);
}

double angle_deg(Vec3f a, Vec3f b) { return degrees(angle_rad(Vec3d(a), Vec3d(b))); }

TEST(NormalCoding, ZeroStoresAsTheUpperHalf) {
  const Vec3f flat{0, 0, 1};
  std::uint8_t bytes[3];
  encode_normals(&flat, 1, {}, SampleType::kUint8, bytes);
  EXPECT_EQ(bytes[0], 128);
  EXPECT_EQ(bytes[1], 128);
  EXPECT_EQ(bytes[2], 255);
  std::uint16_t words[3];
  encode_normals(&flat, 1, {}, SampleType::kUint16, words);
  EXPECT_EQ(words[0], 32768);
  EXPECT_EQ(words[1], 32768);
  EXPECT_EQ(words[2], 65535);
}

TEST(NormalCoding, EndsOfTheRangeAreExact) {
  const Vec3f ends[3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::uint8_t bytes[9];
  encode_normals(ends, 3, {}, SampleType::kUint8, bytes);
  EXPECT_EQ(bytes[0], 0);
  EXPECT_EQ(bytes[4], 0);
  EXPECT_EQ(bytes[8], 0);
}

TEST(NormalCoding, FlatComesBackAThirdOfADegreeOffInEightBits) {
  const ScratchDir dir;
  write_samples(dir / "n.png", SampleType::kUint8, 1, 1, 3, {128 / 255.f, 128 / 255.f, 1});
  const Vec3f back = read_all(dir / "n.png")[0];
  EXPECT_NEAR(angle_deg(back, {0, 0, 1}), 0.3178, 1e-4);
  EXPECT_GT(back.x, 0);
  EXPECT_GT(back.y, 0);
}

TEST(NormalCoding, RoundTripIsAsGoodAsTheSamples) {
  const ScratchDir dir;
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  std::vector<Vec3f> normals(1000);
  for (Vec3f& n : normals) n = Vec3f(normalized(Vec3d{gauss(random), gauss(random), gauss(random)}));
  struct Case {
    const char* file;
    SampleType sample;
    double worst_deg;  // half a step in each of three components
  };
  for (const Case& c : {Case{"n.png", SampleType::kUint8, 0.39}, Case{"n.tif", SampleType::kUint16, 0.0016},
                        Case{"n.exr", SampleType::kHalf, 0.05}, Case{"n.exr", SampleType::kFloat, 1e-5}})
    for (const GreenAxis green : {GreenAxis::kUp, GreenAxis::kDown})
      for (const NormalEncoding encoding : {NormalEncoding::kByType, NormalEncoding::kBiased}) {
        const NormalCoding coding{green, encoding, ""};
        ImageWriter writer(dir / c.file, file_type_of(c.file), c.sample, 100, 10, 3);
        std::vector<float> row(300);
        for (int y = 0; y < 10; y++) {
          encode_normals(normals.data() + 100 * y, 100, coding, c.sample, row.data());
          if (c.sample == SampleType::kUint8 || c.sample == SampleType::kUint16)
            writer.write_rows_stored(1, row.data());
          else writer.write_rows(1, row.data());
        }
        writer.close();
        const std::vector<Vec3f> back = read_all(dir / c.file, coding);
        for (std::size_t i = 0; i < back.size(); i++) {
          ASSERT_LT(angle_deg(back[i], normals[i]), c.worst_deg) << c.file << " " << name(c.sample) << " texel " << i;
          ASSERT_NEAR(length(back[i]), 1, 1e-6);
        }
      }
}

TEST(NormalCoding, GreenDownFlipsYAlone) {
  const ScratchDir dir;
  write_samples(dir / "n.exr", SampleType::kFloat, 1, 1, 3, {0.6f, 0.48f, 0.64f});
  const Vec3f up = read_all(dir / "n.exr")[0], down = read_all(dir / "n.exr", {GreenAxis::kDown, {}, ""})[0];
  EXPECT_FLOAT_EQ(up.y, 0.48f);
  EXPECT_FLOAT_EQ(down.y, -0.48f);
  EXPECT_EQ(up.x, down.x);
  EXPECT_EQ(up.z, down.z);
}

TEST(NormalCoding, DecodingRenormalises) {
  const ScratchDir dir;
  write_samples(dir / "n.exr", SampleType::kFloat, 2, 1, 3, {0, 3, 4, 0, 0, -0.01f});
  const std::vector<Vec3f> n = read_all(dir / "n.exr");
  EXPECT_FLOAT_EQ(n[0].y, 0.6f);
  EXPECT_FLOAT_EQ(n[0].z, 0.8f);
  EXPECT_FLOAT_EQ(n[1].z, -1.f);
}

TEST(NormalCoding, TooShortVectorsAreCountedAndStandUpright) {
  const ScratchDir dir;
  write_samples(dir / "n.exr", SampleType::kFloat, 4, 1, 3, {0, 0, 0, 9e-4f, 0, 0, 0, 0, -1.1e-3f, 1, 0, 0});
  NormalReader reader(dir / "n.exr", {});
  std::vector<Vec3f> n(4);
  reader.read_rows(0, 1, n.data());
  EXPECT_EQ(reader.invalid_texels(), 2u);
  EXPECT_EQ(n[0], (Vec3f{0, 0, 1}));
  EXPECT_EQ(n[1], (Vec3f{0, 0, 1}));
  EXPECT_EQ(n[2], (Vec3f{0, 0, -1}));
  EXPECT_EQ(n[3], (Vec3f{1, 0, 0}));
}

TEST(NormalCoding, NaNAndInfinityAreRefusedWithTheirPlace) {
  const ScratchDir dir;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> samples(5 * 4 * 3, 0.5f);
    samples[(2 * 5 + 3) * 3 + 1] = bad;
    samples[(3 * 5 + 0) * 3 + 1] = bad;
    write_samples(dir / "n.exr", SampleType::kFloat, 5, 4, 3, samples);
    for (int repeat = 0; repeat < 20; repeat++)  // the first, whichever thread meets which
      EXPECT_ERROR(read_all(dir / "n.exr"), ErrorKind::kMalformed, "column 3, row 2");
  }
}

TEST(NormalCoding, ChannelsByLetter) {
  const ScratchDir dir;
  const float x = 0.36f, y = -0.48f, z = 0.8f;
  const auto biased = [](float v) { return 0.5f * v + 0.5f; };
  // x in alpha, y in green, as DXT5 normal maps have it.
  write_samples(dir / "ag.tif", SampleType::kUint16, 1, 1, 4, {1, biased(y), 0, biased(x)});
  // x in red, y in blue.
  write_samples(dir / "xz.exr", SampleType::kFloat, 1, 1, 3, {x, 7, y});
  write_samples(dir / "xy.exr", SampleType::kFloat, 1, 1, 2, {x, y});
  write_samples(dir / "four.exr", SampleType::kFloat, 1, 1, 4, {x, y, z, 0.1f});
  struct Case {
    const char *file, *channels;
  };
  for (const Case& c : {Case{"ag.tif", "ag"}, Case{"ag.tif", "AG"}, Case{"ag.tif", "wy"}, Case{"xz.exr", "xz"},
                        Case{"xz.exr", "rb"}, Case{"xy.exr", "xy"}, Case{"xy.exr", "rg"}, Case{"four.exr", ""},
                        Case{"four.exr", "xyz"}, Case{"four.exr", "rgb"}, Case{"four.exr", "xy"}}) {
    const Vec3f n = read_all(dir / c.file, {GreenAxis::kUp, {}, c.channels})[0];
    EXPECT_LT(angle_deg(n, {x, y, z}), 0.004) << c.file << " read as '" << c.channels << "'";
  }
}

TEST(NormalCoding, ARebuiltZNeverTurnsUnder) {
  const ScratchDir dir;
  write_samples(dir / "xy.exr", SampleType::kFloat, 2, 1, 2, {0.9f, 0.9f, 0, 0});
  const std::vector<Vec3f> n = read_all(dir / "xy.exr", {GreenAxis::kUp, {}, "xy"});
  EXPECT_EQ(n[0].z, 0.f);
  EXPECT_NEAR(length(n[0]), 1, 1e-6);
  EXPECT_EQ(n[1], (Vec3f{0, 0, 1}));
}

TEST(NormalCoding, FilesWithoutTheChannels) {
  const ScratchDir dir;
  write_samples(dir / "one.png", SampleType::kUint8, 1, 1, 1, {0});
  write_samples(dir / "two.exr", SampleType::kFloat, 1, 1, 2, {0, 0});
  write_samples(dir / "three.png", SampleType::kUint8, 1, 1, 3, {0, 0, 1});
  EXPECT_ERROR(read_all(dir / "one.png"), ErrorKind::kMalformed, "expected 3 channels of a normal map, got 1");
  EXPECT_ERROR(read_all(dir / "two.exr"), ErrorKind::kMalformed, "--channels xy");
  EXPECT_ERROR(read_all(dir / "three.png", {GreenAxis::kUp, {}, "ag"}), ErrorKind::kMalformed, "'a'");
  EXPECT_ERROR(read_all(dir / "one.png", {GreenAxis::kUp, {}, "xy"}), ErrorKind::kMalformed, "1 channel");
  for (const char* junk : {"x", "xyzw", "qq", "x1"})
    EXPECT_ERROR(read_all(dir / "three.png", {GreenAxis::kUp, {}, junk}), ErrorKind::kUsage, junk);
}

TEST(NormalCoding, EncodingsOverrideTheType) {
  const ScratchDir dir;
  write_samples(dir / "biased.exr", SampleType::kFloat, 1, 1, 3, {0.5f, 0.8f, 0.9f});
  const Vec3f n = read_all(dir / "biased.exr", {GreenAxis::kUp, NormalEncoding::kBiased, ""})[0];
  EXPECT_NEAR(n.x, 0, 1e-6);
  EXPECT_NEAR(n.y, 0.6f, 1e-6);
  EXPECT_NEAR(n.z, 0.8f, 1e-6);
  EXPECT_ERROR(require_encodable({GreenAxis::kUp, NormalEncoding::kSigned, ""}, SampleType::kUint8, "x.png"),
               ErrorKind::kUnsupported, "signed");
  EXPECT_NO_THROW(require_encodable({GreenAxis::kUp, NormalEncoding::kSigned, ""}, SampleType::kHalf, "x.exr"));
  EXPECT_NO_THROW(require_encodable({GreenAxis::kUp, NormalEncoding::kBiased, ""}, SampleType::kFloat, "x.exr"));
}

}  // namespace
}  // namespace burnish
