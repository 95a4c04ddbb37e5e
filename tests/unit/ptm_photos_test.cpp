#include <gtest/gtest.h>
#include <png.h>

#include <random>

#include "burnish/ptm/photos/capture.h"
#include "expect_error.h"
#include "ptm_capture_fixture.h"

namespace burnish {
namespace {

using testing::Samples;
using testing::ScratchDir;

constexpr int kWidth = 37, kHeight = 29;

Samples gradients(int seed = 0) {
  Samples s;
  for (int y = 0; y < kHeight; y++)
    for (int x = 0; x < kWidth; x++)
      for (int c = 0; c < 3; c++) s.push_back(float((x * (3 + c) + y * (2 + seed) + 40 * c) % 256));
  return s;
}

// All rows of every photograph of a capture.
std::vector<Samples> all_of(const Capture& capture) {
  std::vector<Samples> photos(capture.count());
  capture.for_each_band(
      [&](const PhotoBand& band) {
        const std::size_t samples = std::size_t(capture.width()) * 3 * band.rows;
        for (int i = 0; i < capture.count(); i++)
          for (std::size_t s = 0; s < samples; s++)
            photos[i].push_back(capture.bytes() ? band.bytes[band.stride * i + s] : band.floats[band.stride * i + s]);
      },
      {});
  return photos;
}

Samples only(const std::string& file, std::size_t memory = 1 << 20) {
  const ScratchDir dir;
  return all_of(Capture({file}, memory, dir.path()))[0];
}

void write_interlaced_png(const std::string& path, const Samples& samples) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, kWidth, kHeight, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  std::vector<std::uint8_t> bytes(samples.begin(), samples.end());
  std::vector<png_bytep> rows;
  for (int y = 0; y < kHeight; y++) rows.push_back(bytes.data() + std::size_t(y) * kWidth * 3);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(Capture, SamplesComeAsTheyAreStored) {
  const ScratchDir dir;
  const Samples wanted = gradients();
  testing::write_photo(dir / "a.png", FileType::kPng, SampleType::kUint8, kWidth, wanted);
  testing::write_photo(dir / "b.tif", FileType::kTiff, SampleType::kUint16, kWidth, wanted);
  testing::write_photo(dir / "c.exr", FileType::kExr, SampleType::kFloat, kWidth, wanted);
  testing::write_photo(dir / "d.tga", FileType::kTga, SampleType::kUint8, kWidth, wanted);
  write_interlaced_png(dir / "e.png", wanted);
  for (const char* name : {"a.png", "d.tga", "e.png"}) {
    EXPECT_TRUE(Capture({dir / name}, 1 << 20, dir.path()).bytes()) << name;
    EXPECT_EQ(only(dir / name), wanted) << name;
  }
  for (const char* name : {"b.tif", "c.exr"}) {
    EXPECT_FALSE(Capture({dir / name}, 1 << 20, dir.path()).bytes()) << name;
    const Samples got = only(dir / name);
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); i++) EXPECT_NEAR(got[i], wanted[i], 2e-5 * 255) << name << " " << i;
  }
  // Of both kinds together all are floats.
  const std::vector<Samples> both = all_of(Capture({dir / "e.png", dir / "c.exr", dir / "a.png"}, 1 << 20, dir.path()));
  EXPECT_EQ(both[0], wanted);
  EXPECT_EQ(both[2], wanted);
}

TEST(Capture, WhatOnlyComesWholeIsTheSameAndLeavesNothing) {
  const ScratchDir dir;
  for (const int seed : {0, 1}) {
    testing::write_jpeg(dir / ("base" + std::to_string(seed) + ".jpg"), kWidth, gradients(seed));
    testing::write_jpeg(dir / ("progressive" + std::to_string(seed) + ".jpg"), kWidth, gradients(seed), true);
  }
  EXPECT_FALSE(open_photo(dir / "base0.jpg")->form().whole);
  EXPECT_TRUE(open_photo(dir / "progressive0.jpg")->form().whole);
  for (const std::size_t memory : {1, 1 << 24}) {  // bands of one row, and of all
    const auto one = all_of(Capture({dir / "base0.jpg", dir / "base1.jpg"}, memory, dir.path()));
    const auto other = all_of(Capture({dir / "progressive0.jpg", dir / "progressive1.jpg"}, memory, dir.path()));
    const auto mixed = all_of(Capture({dir / "progressive0.jpg", dir / "base1.jpg"}, memory, dir.path()));
    EXPECT_EQ(one, other);
    EXPECT_EQ(one, mixed);
    EXPECT_NE(one[0], one[1]);
  }
  EXPECT_EQ(dir.entries(), 4u);
}

TEST(Capture, MayBeReadAgain) {
  const ScratchDir dir;
  testing::write_jpeg(dir / "a.jpg", kWidth, gradients());
  testing::write_jpeg(dir / "b.jpg", kWidth, gradients(1), true);
  const Capture capture({dir / "a.jpg", dir / "b.jpg"}, 1 << 10, dir.path());
  EXPECT_EQ(all_of(capture), all_of(capture));
}

TEST(Capture, GreyIsTakenAsRedGreenAndBlue) {
  const ScratchDir dir;
  Image grey(kWidth, kHeight, 1), with_alpha(kWidth, kHeight, 4);
  Samples one(kWidth * kHeight), wanted;
  for (int i = 0; i < kWidth * kHeight; i++) {
    one[i] = float(i % 251);
    grey.data[i] = with_alpha.data[4 * i] = with_alpha.data[4 * i + 1] = with_alpha.data[4 * i + 2] = one[i] / 255;
    with_alpha.data[4 * i + 3] = 0.25f;
    wanted.insert(wanted.end(), 3, one[i]);
  }
  write_image(dir / "grey.png", FileType::kPng, SampleType::kUint8, grey);
  write_image(dir / "alpha.png", FileType::kPng, SampleType::kUint8, with_alpha);
  testing::write_jpeg(dir / "grey.jpg", kWidth, one, false, 1);
  EXPECT_EQ(only(dir / "grey.png"), wanted);
  EXPECT_EQ(only(dir / "alpha.png"), wanted);
  const Samples jpeg = only(dir / "grey.jpg");
  for (std::size_t i = 0; i < jpeg.size(); i += 3) EXPECT_TRUE(jpeg[i] == jpeg[i + 1] && jpeg[i] == jpeg[i + 2]) << i;
}

TEST(Capture, WhatIsNoPhotoIsRefusedByName) {
  const ScratchDir dir;
  const Samples samples = gradients();
  testing::write_jpeg(dir / "a.jpg", kWidth, samples);
  testing::write_jpeg(dir / "narrow.jpg", kHeight, samples);
  testing::write_jpeg(dir / "cmyk.jpg", kWidth, Samples(kWidth * kHeight * 4, 100.0f), false, 4);
  testing::write_bytes(dir / "text.jpg", "a photograph");
  Samples holed = samples;
  holed[(5 * kWidth + 7) * 3 + 1] = std::nanf("");
  testing::write_photo(dir / "holed.exr", FileType::kExr, SampleType::kFloat, kWidth, holed);
  const auto refused = [&](const std::string& name, ErrorKind kind, const std::string& why) {
    EXPECT_ERROR(all_of(Capture({dir / "a.jpg", dir / name}, 1 << 20, dir.path())), kind, name + "': " + why);
  };
  refused("none.jpg", ErrorKind::kIo, "");
  refused("narrow.jpg", ErrorKind::kMalformed, "expected 37x29 texels as in '" + dir / "a.jpg" + "', got 29x37");
  refused("cmyk.jpg", ErrorKind::kUnsupported, "expected red, green and blue, or grey, got 4 components");
  refused("text.jpg", ErrorKind::kMalformed, "expected an image");
  refused("holed.exr", ErrorKind::kMalformed, "expected finite values, got nan at column 7, row 5");
}

// Nothing is made up for what is missing, wherever the file ends.
TEST(Capture, JpegCutShortIsRefused) {
  const ScratchDir dir;
  for (const bool progressive : {false, true}) {
    testing::write_jpeg(dir / "whole.jpg", kWidth, gradients(), progressive);
    const std::string bytes = testing::bytes_of(dir / "whole.jpg");
    for (std::size_t size = 3; size < bytes.size(); size += 1 + size / 6) {
      testing::write_bytes(dir / "short.jpg", bytes.substr(0, size));
      EXPECT_ERROR(only(dir / "short.jpg"), ErrorKind::kMalformed, "short.jpg': ");
    }
    testing::write_bytes(dir / "short.jpg", bytes.substr(0, bytes.size() - 2));
    EXPECT_ERROR(only(dir / "short.jpg"), ErrorKind::kMalformed, "short.jpg': ");
  }
}

// Whatever bytes change, the photograph is read or refused.
TEST(Capture, DamagedFilesAreErrorsAtMost) {
  const ScratchDir dir;
  std::mt19937 random(5);
  int refused = 0, read = 0;
  for (const bool progressive : {false, true}) {
    testing::write_jpeg(dir / "whole.jpg", kWidth, gradients(), progressive);
    const std::string whole = testing::bytes_of(dir / "whole.jpg");
    for (int i = 0; i < 300; i++) {
      std::string bytes = whole;
      for (unsigned n = random() % 4 + 1; n > 0; n--) bytes[2 + random() % (bytes.size() - 2)] = char(random());
      testing::write_bytes(dir / "a.jpg", bytes);
      try {
        const FileRef file = dir / "a.jpg";
        if (const PhotoForm form = open_photo(file)->form(); form.width > 4096 || form.height > 4096) continue;
        read += all_of(Capture({file}, 1 << 20, dir.path()))[0].size() > 0;
      } catch (const Error& error) {
        EXPECT_TRUE(error.kind() == ErrorKind::kMalformed || error.kind() == ErrorKind::kUnsupported) << error.what();
        refused++;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace burnish
