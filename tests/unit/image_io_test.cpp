#include "burnish/core/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "burnish/core/whole_image.h"
#include "expect_error.h"
#include "image_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of, testing::expect_same, testing::random_image;
using testing::ScratchDir;
using testing::write_bytes;

struct Kind {
  const char* file;
  FileType type;
  SampleType sample;
};

const std::vector<Kind>& kinds() {
  using enum SampleType;
  static const std::vector<Kind> all{
      {"x.png", FileType::kPng, kUint8},   {"x.png", FileType::kPng, kUint16}, {"x.tga", FileType::kTga, kUint8},
      {"x.bmp", FileType::kBmp, kUint8},   {"x.tif", FileType::kTiff, kUint8}, {"x.tif", FileType::kTiff, kUint16},
      {"x.tiff", FileType::kTiff, kFloat}, {"x.exr", FileType::kExr, kHalf},   {"x.exr", FileType::kExr, kFloat},
  };
  return all;
}

std::string describe(const Kind& k, int channels) {
  return std::string(name(k.type)) + " " + name(k.sample) + " with " + std::to_string(channels) + " channels";
}

TEST(ImageIo, RoundTripOfEveryTypeAndChannelCount) {
  const ScratchDir dir;
  for (const Kind& k : kinds())
    for (int channels : {1, 3, 4}) {
      if (k.type == FileType::kBmp && channels == 4) continue;  // the codec writes 24 bits
      const Image image = random_image(37, 23, channels, k.sample);
      write_image(dir / k.file, k.type, k.sample, image);
      ImageReader reader(dir / k.file);
      EXPECT_EQ(reader.width(), 37);
      EXPECT_EQ(reader.height(), 23);
      EXPECT_EQ(reader.sample_type(), k.sample) << describe(k, channels);
      EXPECT_EQ(reader.integer(), k.sample == SampleType::kUint8 || k.sample == SampleType::kUint16);
      const Image back = read_image(dir / k.file);
      // BMP stores grey as a palette or as three equal channels: the values are what counts.
      ASSERT_TRUE(back.channels == channels || k.type == FileType::kBmp) << describe(k, channels);
      for (std::size_t t = 0; t < image.texels(); t++)
        for (int c = 0; c < channels; c++)
          ASSERT_FLOAT_EQ(back.data[t * back.channels + c], image.data[t * channels + c])
              << describe(k, channels) << ", texel " << t << ", channel " << c;
    }
}

TEST(ImageIo, AlphaIsDataAndTouchesNoColour) {
  const ScratchDir dir;
  for (const Kind& k : kinds()) {
    if (k.type == FileType::kBmp) continue;
    Image image(4, 1, 4);
    const float one = 1.f, grey = k.sample == SampleType::kUint8    ? 51.f / 255.f
                                  : k.sample == SampleType::kUint16 ? 13107.f / 65535.f
                                                                    : 0.25f;
    const float alphas[4] = {0.f, grey, one, 0.f};
    for (int x = 0; x < 4; x++) {
      float* t = image.at(x, 0);
      t[0] = one, t[1] = grey, t[2] = x == 3 ? 0.f : one, t[3] = alphas[x];
    }
    write_image(dir / k.file, k.type, k.sample, image);
    expect_same(read_image(dir / k.file).data, image.data, describe(k, 4));
  }
}

TEST(ImageIo, EverySixteenBitValueSurvives) {
  const ScratchDir dir;
  for (const char* file : {"x.png", "x.tif"}) {
    std::vector<std::uint16_t> values(65536);
    for (std::size_t i = 0; i < values.size(); i++) values[i] = std::uint16_t(i);
    {
      ImageWriter writer(dir / file, file_type_of(file), SampleType::kUint16, 256, 256, 1);
      writer.write_rows_stored(256, values.data());
      writer.close();
    }
    ImageReader reader(dir / file);
    ASSERT_TRUE(reader.has_exact_samples());
    std::vector<std::uint16_t> stored(65536);
    reader.read_rows_stored(0, 256, stored.data());
    EXPECT_EQ(stored, values) << file;
    const Image floats = read_image(dir / file);
    for (std::size_t i = 0; i < values.size(); i++)
      ASSERT_EQ(std::lround(double(floats.data[i]) * 65535), long(i)) << file;
    write_image(dir / file, file_type_of(file), SampleType::kUint16, floats);  // through floats and back
    ImageReader again(dir / file);
    again.read_rows_stored(0, 256, stored.data());
    EXPECT_EQ(stored, values) << file << " through floats";
  }
}

TEST(ImageIo, FloatsAreRoundedHalfUpAndClampedInIntegers) {
  const ScratchDir dir;
  Image image(6, 1);
  image.data = {0.5f, -1.f, 2.f, 0.f, 1.f, 100.49f / 255.f};
  write_image(dir / "x.png", FileType::kPng, SampleType::kUint8, image);
  ImageReader reader(dir / "x.png");
  std::uint8_t stored[6];
  reader.read_rows_stored(0, 1, stored);
  const std::uint8_t expected[6] = {128, 0, 255, 0, 255, 100};
  for (int i = 0; i < 6; i++) EXPECT_EQ(stored[i], expected[i]) << "texel " << i;
}

TEST(ImageIo, FloatsKeepWhatIsBeyondTheRange) {
  const ScratchDir dir;
  Image image(4, 1);
  image.data = {-3.5f, 1e6f, 1e-30f, 0.1f};
  for (const char* file : {"x.exr", "x.tif"}) {
    write_image(dir / file, file_type_of(file), SampleType::kFloat, image);
    EXPECT_EQ(read_image(dir / file).data, image.data) << file;
  }
}

TEST(ImageIo, NoClockAndTheSameBytesAgain) {
  const ScratchDir dir;
  for (const Kind& k : kinds()) {
    const Image image = random_image(16, 9, 3, k.sample);
    write_image(dir / k.file, k.type, k.sample, image);
    const std::string first = bytes_of(dir / k.file);
    EXPECT_EQ(first.find("tIME"), std::string::npos) << describe(k, 3) << " holds the clock";
    EXPECT_EQ(first.find(dir.path()), std::string::npos) << describe(k, 3) << " holds its own path";
    std::filesystem::create_directories(dir / "other");
    write_image(dir / (std::string("other/") + k.file), k.type, k.sample, image);
    EXPECT_EQ(bytes_of(dir / (std::string("other/") + k.file)), first) << describe(k, 3);
  }
}

TEST(ImageIo, OneChannelIsNamedY) {
  const ScratchDir dir;
  write_image(dir / "x.exr", FileType::kExr, SampleType::kHalf, Image(2, 2, 1));
  EXPECT_EQ(ImageReader(dir / "x.exr").channel_names(), std::vector<std::string>{"Y"});
  write_image(dir / "x.exr", FileType::kExr, SampleType::kHalf, Image(2, 2, 4));
  EXPECT_EQ(ImageReader(dir / "x.exr").channel_names(), (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST(ImageIo, ContentAndNotTheNameSaysWhatAFileIs) {
  const ScratchDir dir;
  const Image image = random_image(5, 4, 3, SampleType::kUint8);
  write_image(dir / "x.png", FileType::kPng, SampleType::kUint8, image);
  std::filesystem::rename(dir / "x.png", dir / "really-a-png.exr");
  expect_same(read_image(dir / "really-a-png.exr").data, image.data, "a PNG named .exr");
  write_bytes(dir / "ascii.dat", "P2\n2 2\n255\n0 51\n102 255\n");
  expect_same(read_image(dir / "ascii.dat").data, {0, 51 / 255.f, 102 / 255.f, 1}, "a PGM named .dat");
}

// As TIFF files beyond 4 GB are: offsets of 64 bits.
TEST(ImageIo, ABigTiffIsATiff) {
  const ScratchDir dir;
  std::string file("II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0", 16);
  const auto append = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; i++) file += char(value >> 8 * i);
  };
  const std::pair<int, std::uint64_t> tags[] = {{256, 2}, {257, 1}, {258, 8}, {259, 1}, {262, 1},
                                                {273, 0}, {277, 1}, {278, 1}, {279, 2}};
  const std::uint64_t texels_at = 16 + 8 + 20 * std::size(tags) + 8;
  append(std::size(tags), 8);
  for (const auto& [tag, value] : tags)
    append(tag, 2), append(16, 2), append(1, 8), append(tag == 273 ? texels_at : value, 8);
  append(0, 8);
  write_bytes(dir / "big.tif", file + std::string("\0\xff", 2));
  EXPECT_EQ(read_image(dir / "big.tif").data, (std::vector<float>{0, 1}));
}

TEST(ImageIo, MoreRowsThanAnImageHasAreRefused) {
  const ScratchDir dir;
  const std::vector<float> rows(4 * 9);
  ImageWriter writer(dir / "x.png", FileType::kPng, SampleType::kUint8, 4, 8, 1);
  writer.write_rows(5, rows.data());
  EXPECT_ERROR(writer.write_rows(4, rows.data()), ErrorKind::kInternal, "8 rows");
}

TEST(ImageIo, WhatCannotBeReadSaysWhy) {
  const ScratchDir dir;
  EXPECT_ERROR(read_image(dir / "missing.png"), ErrorKind::kIo, "missing.png': cannot be read");
  EXPECT_ERROR(read_image(dir.path()), ErrorKind::kIo, "directory");
  write_bytes(dir / "empty.png", "");
  EXPECT_ERROR(read_image(dir / "empty.png"), ErrorKind::kMalformed, "empty.png");
  write_bytes(dir / "text.png", "not an image\n");
  EXPECT_ERROR(read_image(dir / "text.png"), ErrorKind::kMalformed, "text.png");
  EXPECT_ERROR(read_image(FileRef(dir / "text.png", kStandardInput)), ErrorKind::kMalformed, "standard input");
}

TEST(ImageIo, FilesCutShortAnywhereAreRefusedNotReadAsSomething) {
  const ScratchDir dir;
  for (const Kind& k : kinds()) {
    write_image(dir / k.file, k.type, k.sample, random_image(64, 64, 3, k.sample));
    const std::string whole = bytes_of(dir / k.file);
    for (double part : {0.01, 0.1, 0.5, 0.9}) {
      write_bytes(dir / "cut", "");
      const std::string cut = dir / ("cut" + std::filesystem::path(k.file).extension().string());
      write_bytes(cut, whole.substr(0, std::size_t(double(whole.size()) * part)));
      try {
        read_image(cut);
        ADD_FAILURE() << describe(k, 3) << " cut to " << part << " was read";
      } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::kMalformed) << describe(k, 3) << ": " << e.what();
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      }
    }
  }
}

TEST(ImageIo, APngWithAWrongChecksumIsRefused) {
  const ScratchDir dir;
  write_image(dir / "x.png", FileType::kPng, SampleType::kUint8, random_image(64, 64, 3, SampleType::kUint8));
  std::string bytes = bytes_of(dir / "x.png");
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 0xff);
  write_bytes(dir / "x.png", bytes);
  EXPECT_ERROR(read_image(dir / "x.png"), ErrorKind::kMalformed, "x.png");
}

TEST(ImageIo, NamesAndSamplesThatAFileTypeDoesNotHave) {
  EXPECT_ERROR(file_type_of("a.gif"), ErrorKind::kUnsupported, ".gif");
  EXPECT_ERROR(file_type_of("a"), ErrorKind::kUnsupported, "'a'");
  EXPECT_EQ(file_type_of("A.PNG"), FileType::kPng);
  EXPECT_EQ(file_type_of("a.b/c.tiff"), FileType::kTiff);
  using enum SampleType;
  for (const auto& [type, samples] :
       std::vector<std::pair<FileType, std::vector<SampleType>>>{{FileType::kPng, {kHalf, kFloat}},
                                                                 {FileType::kTga, {kUint16, kHalf, kFloat}},
                                                                 {FileType::kBmp, {kUint16, kHalf, kFloat}},
                                                                 {FileType::kTiff, {kHalf}},
                                                                 {FileType::kExr, {kUint8, kUint16}}})
    for (SampleType s : samples) EXPECT_ERROR(require_can_hold(type, s, "f"), ErrorKind::kUnsupported, name(s));
  for (FileType t : {FileType::kPng, FileType::kTga, FileType::kBmp, FileType::kTiff, FileType::kExr})
    EXPECT_NO_THROW(require_can_hold(t, default_sample_type(t), "f"));
}

TEST(ImageIo, WritingWhereNothingCanBeIsAnIoError) {
  const ScratchDir dir;
  for (const Kind& k : kinds())
    EXPECT_ERROR(write_image(dir / (std::string("missing/") + k.file), k.type, k.sample, Image(4, 4, 3)),
                 ErrorKind::kIo, k.file);
}

// Every write to /dev/full fails with ENOSPC; a small image meets it at close only.
TEST(ImageIo, AFullDiskIsAnIoError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const Kind& k : kinds())
    for (int side : {4, 700}) {
      if (k.type == FileType::kTiff || k.type == FileType::kExr)
        continue;  // they seek; the command-line tests have a disk
      EXPECT_ERROR(write_image("/dev/full", k.type, k.sample, random_image(side, side, 3, k.sample)), ErrorKind::kIo,
                   "cannot be written");
    }
}

TEST(ImageIo, AWholeImageIsReadInBands) {
  const std::size_t per_row = std::size_t(1) << 21;
  std::vector<int> firsts;
  const auto values = read_whole<std::uint8_t>("x", 5, per_row, [&](int first, int count, std::uint8_t* out) {
    firsts.push_back(first);
    for (int j = 0; j < count; j++) std::memset(out + std::size_t(j) * per_row, first + j, per_row);
  });
  EXPECT_EQ(firsts, (std::vector<int>{0, 2, 4}));
  ASSERT_EQ(values.size(), 5 * per_row);
  for (int j = 0; j < 5; j++) {
    EXPECT_EQ(values[j * per_row], j);
    EXPECT_EQ(values[(j + 1) * per_row - 1], j);
  }
}

TEST(ImageIo, AFileThatPromisesMoreThanItHoldsIsRefusedByItsName) {
  const ScratchDir dir;
  write_bytes(dir / "huge.ppm", "P6\n60000 60000\n255\n" + std::string(200000, 'x'));
  EXPECT_ERROR(read_image(dir / "huge.ppm"), ErrorKind::kMalformed, "huge.ppm'");
  EXPECT_ERROR(ImageReader(dir / "huge.ppm").read_level(0), ErrorKind::kMalformed, "huge.ppm'");
  const auto full = [](int first, int, float*) {
    if (first > 0) throw std::bad_alloc();
  };
  EXPECT_ERROR(read_whole<float>("x.png", 60000, 1000, full), ErrorKind::kUnsupported,
               "'x.png': is larger than memory: 60000 rows of 1000 values");
}

TEST(ImageIo, MasksAreTheFirstChannelOfAnyImageOfThatSize) {
  const ScratchDir dir;
  Image image(3, 1, 3);
  image.data = {0, 1, 1, 1, 0, 0, 1 / 255.f, 0, 0};
  write_image(dir / "m.png", FileType::kPng, SampleType::kUint8, image);
  EXPECT_EQ(read_mask(dir / "m.png", 3, 1).data, (std::vector<std::uint8_t>{0, 1, 1}));
  EXPECT_ERROR(read_mask(dir / "m.png", 4, 1), ErrorKind::kMalformed, "expected 4x1");
  EXPECT_ERROR(read_mask(dir / "missing.png", 3, 1), ErrorKind::kIo, "missing.png");
}

TEST(ImageIo, MaterialIdsAreOneChannelOfEightBits) {
  const ScratchDir dir;
  Image image(3, 1);
  image.data = {0, 7 / 255.f, 1};
  write_image(dir / "i.png", FileType::kPng, SampleType::kUint8, image);
  EXPECT_EQ(read_ids(dir / "i.png", 3, 1).data, (std::vector<std::uint8_t>{0, 7, 255}));
  EXPECT_ERROR(read_ids(dir / "i.png", 1, 3), ErrorKind::kMalformed, "expected 1x3");
  write_image(dir / "i.png", FileType::kPng, SampleType::kUint16, image);
  EXPECT_ERROR(read_ids(dir / "i.png", 3, 1), ErrorKind::kMalformed, "uint8");
  write_image(dir / "i.png", FileType::kPng, SampleType::kUint8, Image(3, 1, 3));
  EXPECT_ERROR(read_ids(dir / "i.png", 3, 1), ErrorKind::kMalformed, "1 channel");
}

TEST(ImageWriter, TheSameBytesHoweverRowsCome) {
  const ScratchDir dir;
  Image image(37, 211, 3);
  for (std::size_t i = 0; i < image.data.size(); i++) image.data[i] = float(i * 7 % 256) / 255;
  for (const std::string type : {"png", "tif", "exr"}) {
    const FileType file_type = file_type_of("x." + type);
    write_image(dir / "whole." + type, file_type, default_sample_type(file_type), image);
    for (const std::vector<int>& counts : {std::vector{1}, {63, 1, 130}, {64, 100}, {5, 200}}) {
      ImageWriter writer(dir / "rows." + type, file_type, default_sample_type(file_type), 37, 211, 3);
      for (int y = 0, n = 0; y < image.height; n++) {
        const int count = std::min(counts[n % counts.size()], image.height - y);
        writer.write_rows(count, image.row(y));
        y += count;
      }
      writer.close();
      EXPECT_EQ(bytes_of(dir / "rows." + type), bytes_of(dir / "whole." + type)) << type << " by " << counts[0];
    }
  }
}

}  // namespace
}  // namespace burnish
