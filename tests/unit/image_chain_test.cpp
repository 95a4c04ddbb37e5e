#include "burnish/core/image_chain.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "burnish/core/mip.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::ScratchDir;
using testing::write_bytes;

// Every texel of every level another value, all of which a half holds.
std::vector<Image> some_levels(int width, int height, int channels) {
  std::vector<Image> levels;
  for (int l = 0, count = level_count(width, height); l < count; l++) {
    Image level(width, height, channels);
    for (std::size_t i = 0; i < level.data.size(); i++) level.data[i] = float(int(i % 512) - 256) / 128.f + float(l);
    levels.push_back(level);
    width = next_level_size(width), height = next_level_size(height);
  }
  return levels;
}

void expect_same(const std::vector<Image>& a, const std::vector<Image>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t l = 0; l < a.size(); l++) {
    EXPECT_EQ(a[l].width, b[l].width) << l;
    EXPECT_EQ(a[l].height, b[l].height) << l;
    EXPECT_EQ(a[l].channels, b[l].channels) << l;
    EXPECT_EQ(a[l].data, b[l].data) << l;
  }
}

TEST(ImageChain, RoundTrip) {
  const ScratchDir dir;
  const std::pair<int, int> sizes[] = {{1, 1}, {2, 1}, {1, 9}, {64, 48}, {131, 77}};
  for (const auto& [w, h] : sizes)
    for (int channels : {1, 3, 4})
      for (SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
        const std::vector<Image> levels = some_levels(w, h, channels);
        write_image_chain(dir / "c.exr", sample, levels, {{"burnish:model", "ward"}});
        ImageReader reader(dir / "c.exr");
        EXPECT_EQ(reader.sample_type(), sample);
        EXPECT_EQ(reader.text("burnish:model"), "ward");
        EXPECT_EQ(reader.levels(), int(levels.size()));
        expect_same(read_image_chain(reader), levels);
      }
}

TEST(ImageChain, IsAMipMapRoundedDownForOthers) {
  const ScratchDir dir;
  write_image_chain(dir / "c.exr", SampleType::kHalf, some_levels(37, 20, 4));
  const Imf::TiledInputFile file((dir / "c.exr").c_str());
  EXPECT_EQ(file.levelMode(), Imf::MIPMAP_LEVELS);
  EXPECT_EQ(file.levelRoundingMode(), Imf::ROUND_DOWN);
  EXPECT_EQ(file.numLevels(), 6);
  EXPECT_EQ(file.levelWidth(1), 18);
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  const auto* clock = file.header().findTypedAttribute<Imf::StringAttribute>("capDate");
  EXPECT_TRUE(!clock || clock->value().empty());
  for (const char* channel : {"R", "G", "B", "A"})
    EXPECT_TRUE(file.header().channels().findChannel(channel)) << channel;
}

TEST(ImageChain, SameBytesAgain) {
  const ScratchDir dir;
  for (const char* name : {"a.exr", "b.exr"})
    write_image_chain(dir / name, SampleType::kFloat, some_levels(130, 70, 3), {{"burnish:model", "ward"}});
  EXPECT_EQ(bytes_of(dir / "a.exr"), bytes_of(dir / "b.exr"));
}

// However the rows of levels come, the file is the same, and nothing is left beside it.
TEST(ImageChain, RowsOfLevelsMayTakeTurns) {
  const ScratchDir dir;
  const std::pair<int, int> sizes[] = {{1, 1}, {5, 3}, {127, 65}, {200, 333}};
  for (const auto& [w, h] : sizes)
    for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
      const std::vector<Image> levels = some_levels(w, h, 3);
      write_image_chain(dir / "whole.exr", sample, levels);
      for (const int at_once : {1, 7, 64, 150}) {
        ImageChainWriter writer(dir / "rows.exr", sample, w, h, 3, int(levels.size()));
        std::vector<int> next(levels.size());
        for (bool more = true; more;) {
          more = false;
          for (std::size_t l = 0; l < levels.size(); l++) {
            const int count = std::min(at_once, levels[l].height - next[l]);
            if (count == 0) continue;
            writer.write_rows(int(l), count, levels[l].row(next[l]));
            next[l] += count;
            more = true;
          }
        }
        writer.close();
        EXPECT_EQ(bytes_of(dir / "rows.exr"), bytes_of(dir / "whole.exr")) << w << "x" << h << ", " << at_once;
      }
    }
  EXPECT_EQ(dir.entries(), 2u);
}

TEST(ImageChain, OtherFilesHaveOneLevel) {
  const ScratchDir dir;
  for (const char* name : {"a.png", "a.tif", "a.exr"}) {
    const std::vector<Image> base{Image(5, 4, 3)};
    write_image(dir / name, file_type_of(name), default_sample_type(file_type_of(name)), base[0]);
    ImageReader reader(dir / name);
    EXPECT_EQ(reader.levels(), 1) << name;
    expect_same(read_image_chain(reader), base);
  }
}

TEST(ImageChain, RowsOfTheBaseBetweenLevels) {
  const ScratchDir dir;
  const std::vector<Image> levels = some_levels(100, 90, 1);
  write_image_chain(dir / "c.exr", SampleType::kFloat, levels);
  ImageReader reader(dir / "c.exr");
  std::vector<float> row(100);
  for (int y : {3, 70}) {
    reader.read_rows(y, 1, row.data());
    EXPECT_EQ(row, std::vector<float>(levels[0].row(y), levels[0].row(y) + 100));
    EXPECT_EQ(reader.read_level(2).data, levels[2].data);
  }
}

TEST(ImageChain, ChainsThatEndEarlyAndIntegersAreRefused) {
  const ScratchDir dir;
  std::vector<Image> levels = some_levels(16, 16, 3);
  EXPECT_ERROR(write_image_chain(dir / "c.exr", SampleType::kUint8, levels), ErrorKind::kUnsupported, "c.exr");
  levels.pop_back();
  EXPECT_ERROR(write_image_chain(dir / "c.exr", SampleType::kHalf, levels), ErrorKind::kUnsupported,
               "one level or all 5, not 4");
}

TEST(ImageChain, FilesCutShortAreRefused) {
  const ScratchDir dir;
  write_image_chain(dir / "c.exr", SampleType::kFloat, some_levels(200, 200, 3));
  const std::string bytes = bytes_of(dir / "c.exr");
  for (std::size_t part : {30, 60, 95}) {
    write_bytes(dir / "cut.exr", bytes.substr(0, bytes.size() * part / 100));
    EXPECT_ERROR(
        {
          ImageReader reader(dir / "cut.exr");
          read_image_chain(reader);
        },
        ErrorKind::kMalformed, "cut.exr'");
  }
}

TEST(ImageChain, AFullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  EXPECT_ERROR(write_image_chain("/dev/full", SampleType::kFloat, some_levels(64, 64, 3)), ErrorKind::kIo,
               "No space left");
}

}  // namespace
}  // namespace burnish
