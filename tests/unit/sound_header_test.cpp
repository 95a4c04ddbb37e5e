// Headers that promise more than their file holds are refused before a codec sets memory aside for that.
#include "burnish/core/sound_header.h"

#include <gtest/gtest.h>

#include "burnish/core/image_io.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::ScratchDir;
using testing::write_bytes;

std::string u32(std::uint32_t v) { return {char(v), char(v >> 8), char(v >> 16), char(v >> 24)}; }

std::string attribute(const std::string& name, const std::string& type, std::uint32_t size, const std::string& value) {
  return name + '\0' + type + '\0' + u32(size) + value;
}
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return attribute(name, type, std::uint32_t(value.size()), value);
}
std::string exr(const std::string& attributes, std::uint32_t version = 2) {
  return "v/1\x01" + u32(version) + attributes + '\0';
}
std::string channel(const std::string& name) { return name + '\0' + std::string(16, '\1'); }

class SoundHeader : public ::testing::Test {
 protected:
  void accepted(const std::string& bytes) {
    write_bytes(dir_ / "x", bytes);
    EXPECT_NO_THROW(require_sound_header(dir_ / "x"));
  }
  void refused(const std::string& bytes, const std::string& why) {
    write_bytes(dir_ / "x", bytes);
    EXPECT_ERROR(require_sound_header(dir_ / "x"), ErrorKind::kMalformed, why);
  }

  const ScratchDir dir_;
};

TEST_F(SoundHeader, WhatIsWrittenHereIsSound) {
  for (const auto& [file, type] : {std::pair("x.png", FileType::kPng),
                                   {"x.exr", FileType::kExr},
                                   {"x.bmp", FileType::kBmp},
                                   {"x.tif", FileType::kTiff},
                                   {"x.tga", FileType::kTga}}) {
    write_image(dir_ / file, type, default_sample_type(type), Image(70, 50, 3), {{"burnish:space", "tangent"}});
    EXPECT_NO_THROW(require_sound_header(dir_ / file)) << file;
  }
}

TEST_F(SoundHeader, OtherFilesAndShortOnesAreLeftToTheirReaders) {
  for (const char* bytes : {"", "v/1", "v/1\x01\x02", "\x89PNG\r\n\x1a\n", "BM", "BMxxxx", "P5 70000 70000 255\n"})
    accepted(bytes);
}

TEST_F(SoundHeader, AttributesAreNoLargerThanTheFile) {
  accepted(exr(attribute("a", "string", "text")));
  accepted(exr("") + "chunks that no one looks at");
  refused(exr(attribute("a", "string", 5, "abc")), "expected 5 bytes of the attribute 'a', got 4");
  refused(exr(attribute("a", "mine", 0xfffffff0u, "abc")), "expected 4294967280 bytes of the attribute 'a', got 4");
}

TEST_F(SoundHeader, AttributesOfAllPartsAreLookedAt) {
  constexpr std::uint32_t kSeveralParts = 0x1002;
  const std::string sound = attribute("a", "int", u32(1)) + '\0', wrong = attribute("b", "string", 99, "");
  accepted(exr(sound + wrong));  // of one part the header is over
  accepted(exr(sound + sound, kSeveralParts) + wrong);
  refused(exr(sound + wrong, kSeveralParts), "attribute 'b'");
}

// OpenEXR goes by the type, and would take what follows for the next attribute.
TEST_F(SoundHeader, AttributesHaveTheSizeOfTheirType) {
  accepted(exr(attribute("dataWindow", "box2i", std::string(16, '\0'))));
  refused(exr(attribute("dataWindow", "box2i", std::string(17, '\0'))), "'dataWindow' of the size of its type, got 17");
  refused(exr(attribute("f", "floatvector", "abcde")), "'f' of the size of its type, got 5");
  accepted(exr(attribute("channels", "chlist", channel("R") + channel("G") + '\0')));
  accepted(exr(attribute("channels", "chlist", std::string(1, '\0'))));
  for (const std::string& list : {channel("R"), channel("R") + "G", channel("R") + std::string(2, '\0'), std::string()})
    refused(exr(attribute("channels", "chlist", list)), "'channels' of the size of its type");
}

TEST_F(SoundHeader, RowsAreNotFarLongerThanTheFile) {
  const auto window = [](std::uint32_t from, std::uint32_t to) {
    return exr(attribute("dataWindow", "box2i", u32(from) + u32(0) + u32(to) + u32(0)));
  };
  accepted(window(0, 65535));
  accepted(window(std::uint32_t(-9), 60));
  refused(window(0, 3093000), "is too short for rows of 3093001 texels");
  refused(window(0x80000000u, 0x7fffffff), "is too short for rows of 4294967296 texels");
}

TEST_F(SoundHeader, TilesAreNotFarLargerThanTheFile) {
  const auto tiles = [](std::uint32_t w, std::uint32_t h) {
    return exr(attribute("tiles", "tiledesc", u32(w) + u32(h) + '\0'));
  };
  accepted(tiles(64, 64));
  accepted(tiles(256, 256));
  refused(tiles(16394, 16384), "is too short for tiles of 16394x16384 texels");
  accepted(tiles(1024, 1024) + std::string(2048, 'x'));
}

TEST_F(SoundHeader, ChunksOfAPngAreNoLargerThanTheFile) {
  const std::string signature = "\x89PNG\r\n\x1a\n";
  const auto chunk = [](std::uint32_t size, const std::string& name, const std::string& data) {
    const std::string n = u32(size);
    return std::string(n.rbegin(), n.rend()) + name + data + "sum.";
  };
  accepted(signature + chunk(3, "tEXt", "abc") + chunk(0, "IEND", ""));
  refused(signature + chunk(3, "tEXt", "abc") + chunk(0x70000000, "iTXt", "abc"),
          "expected 1879048192 bytes of the chunk iTXt, got 7");
  accepted(signature + chunk(100, "IDAT", "abc"));  // its reader says that it is cut short
}

TEST_F(SoundHeader, ABmpHoldsNoMoreTexelsThanItsCodes) {
  const auto bmp = [](std::uint32_t w, std::uint32_t h) {
    return "BM" + std::string(12, '\0') + u32(40) + u32(w) + u32(h) + std::string(44, '\0');
  };
  accepted(bmp(70, 128));
  accepted(bmp(70, std::uint32_t(-128)));
  refused(bmp(754974724, 2), "is too short for 754974724x2 texels");
  refused(bmp(4, std::uint32_t(-2500000)), "is too short for 4x2500000 texels");
  refused("BM" + std::string(12, '\0') + u32(12) + u32(60000u | 60000u << 16) + std::string(20, '\0'),
          "is too short for 60000x60000 texels");
}

TEST_F(SoundHeader, ReadersAsk) {
  write_bytes(dir_ / "x.exr", exr(attribute("a", "mine", 0x7fffffff, "abc")));
  EXPECT_ERROR(ImageReader(dir_ / "x.exr"), ErrorKind::kMalformed, "bytes of the attribute 'a'");
  write_bytes(dir_ / "x.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0", 18));
  EXPECT_ERROR(ImageReader(dir_ / "x.tga"), ErrorKind::kMalformed, "is too short for 65535x65535 texels");
}

// What codecs unpack as they open it: of enough bytes for that many texels, and of more texels than the limit.
TEST_F(SoundHeader, WhatIsUnpackedAtOnceIsHeldAgainstTheLimit) {
  const std::string segment("\xff\xe0\x00\x04xx", 6), frame("\xff\xc2\x00\x0b\x08\xff\xdc\xff\xdc\x01", 10);
  accepted("\xff\xd8" + segment + frame);  // too short, as its reader says
  for (const auto& [bytes, size, texels] : {std::tuple("\xff\xd8" + segment + frame, 600000, "4290250000"),
                                            {"P1\n# of bits\n40000 40000\n", 200000000, "1600000000"}}) {
    write_bytes(dir_ / "x", bytes);
    std::filesystem::resize_file(dir_ / "x", std::uintmax_t(size));
    EXPECT_ERROR(require_sound_header(dir_ / "x"), ErrorKind::kUnsupported,
                 std::string("max-texels: expected at least ") + texels);
  }
}

}  // namespace
}  // namespace burnish
