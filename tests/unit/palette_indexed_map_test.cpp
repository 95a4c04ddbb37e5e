#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstring>

#include "burnish/palette/index_mips.h"
#include "burnish/palette/indexed_map.h"
#include "expect_error.h"
#include "indexed_map_checks.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::expect_same;
using testing::expect_survival;
using testing::peak_mib;
using testing::Random;
using testing::random_map;
using testing::ScratchDir;
using testing::write_bytes;

TEST(PaletteIndexedMap, ComesBackAsItWentIn) {
  const ScratchDir dir;
  for (const int entries : {1, 2, 3, 255, 256, 257, 5000, 65536})
    for (const int materials : {1, 3}) {
      if (materials > entries) continue;
      IndexedMap map = random_map(67, 45, entries, materials);
      map.levels[0].data[5] = std::uint16_t(entries - 1);
      map.palette.space = materials == 1 ? NormalSpace::kObject : NormalSpace::kTangent;
      for (const char* file : {"m.exr", "m.png"}) {
        write_indexed_map(dir / file, file_type_of(file), map);
        EXPECT_TRUE(is_indexed_map(dir / file));
        expect_same(map, read_indexed_map(dir / file));
        EXPECT_EQ(read_palette(dir / file).normals, map.palette.normals);
        const std::string bytes = bytes_of(dir / file);
        write_indexed_map(dir / file, file_type_of(file), map);
        EXPECT_EQ(bytes, bytes_of(dir / file)) << "written twice: " << file;
        if (std::strcmp(file, "m.png") == 0) {
          EXPECT_EQ(bytes[25], entries <= 256 ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY) << entries;
          EXPECT_EQ(bytes[24], entries <= 256 ? 8 : 16) << entries;
        }
      }
    }
}

// Every bit of an entry survives the text of a PNG, the smallest too.
TEST(PaletteIndexedMap, APngHoldsThePaletteToTheLastBit) {
  const ScratchDir dir;
  IndexedMap map = random_map(4, 4, 2000, 1);
  for (Vec3f& n : map.palette.normals) n.x *= 1 + 1e-6f;
  map.palette.normals[0] = {1e-30f, -1e-7f, 1};
  map.palette.normals[1] = {std::numeric_limits<float>::denorm_min(), 1, 0};
  write_indexed_map(dir / "m.png", FileType::kPng, map);
  expect_same(map, read_indexed_map(dir / "m.png"));
}

TEST(PaletteIndexedMap, ChainsInExr) {
  const ScratchDir dir;
  for (const auto& [width, height] : {std::pair(64, 64), std::pair(256, 32), std::pair(333, 77), std::pair(1, 9),
                                      std::pair(5, 3), std::pair(129, 200), std::pair(1, 1)}) {
    IndexedMap map = random_map(width, height, 300, 2);
    build_index_mips(map, {});
    write_indexed_map(dir / "m.exr", FileType::kExr, map);
    expect_same(map, read_indexed_map(dir / "m.exr"));
    if (map.levels.size() > 1) {
      EXPECT_ERROR(write_indexed_map(dir / "m.png", FileType::kPng, map), ErrorKind::kUnsupported,
                   "PNG holds one level");
      if (map.levels.size() > 2) {
        map.levels.pop_back();
        EXPECT_ERROR(write_indexed_map(dir / "x.exr", FileType::kExr, map), ErrorKind::kUnsupported,
                     "one level or all");
      }
    }
  }
}

TEST(PaletteIndexedMap, OtherTypesAreNotProvided) {
  const ScratchDir dir;
  const IndexedMap map = random_map(4, 4, 4, 1);
  for (const FileType type : {FileType::kTiff, FileType::kTga, FileType::kBmp}) {
    EXPECT_ERROR(write_indexed_map(dir / "x", type, map), ErrorKind::kUnsupported, "EXR, PNG, KTX2 or DDS");
  }
  for (const FileType type : {FileType::kTiff, FileType::kTga, FileType::kBmp, FileType::kKtx2, FileType::kDds})
    EXPECT_ERROR(write_palette(dir / "x", type, map.palette), ErrorKind::kUnsupported, "EXR or PNG");
}

// A PNG of colour type 3 as any other program writes it.
void write_foreign(const std::string& path, int depth, bool interlaced, int width,
                   const std::vector<png_color>& colours, const std::vector<std::uint8_t>& indices) {
  const int height = int(indices.size()) / width;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  std::FILE* out = std::fopen(path.c_str(), "wb");
  png_init_io(png, out);
  png_set_IHDR(png, info, width, height, depth, PNG_COLOR_TYPE_PALETTE,
               interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_PLTE(png, info, colours.data(), int(colours.size()));
  png_write_info(png, info);
  png_set_packing(png);
  std::vector<png_bytep> rows;
  for (int y = 0; y < height; y++) rows.push_back(const_cast<png_bytep>(indices.data()) + std::size_t(y) * width);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(out);
}

TEST(PaletteForeignPng, EveryBitDepth) {
  const ScratchDir dir;
  Random random(1);
  for (const int depth : {1, 2, 4, 8})
    for (const bool interlaced : {false, true}) {
      const int width = 37, height = 11, entries = 1 << depth;
      const std::vector<Vec3f> normals = random.directions(entries);
      std::vector<png_color> colours;
      const auto byte = [](float v) { return png_byte(v * 127.5f + 128); };
      for (const Vec3f& n : normals) colours.push_back({byte(n.x), byte(n.y), byte(n.z)});
      std::vector<std::uint8_t> indices;
      for (int i = 0; i < width * height; i++) indices.push_back(std::uint8_t(random.below(entries)));
      write_foreign(dir / "f.png", depth, interlaced, width, colours, indices);
      EXPECT_TRUE(is_indexed_map(dir / "f.png"));
      const IndexedMap map = read_indexed_map(dir / "f.png");
      ASSERT_EQ(map.width(), width);
      ASSERT_EQ(map.height(), height);
      EXPECT_TRUE(std::ranges::equal(map.levels[0].data, indices)) << depth << " bits";
      EXPECT_EQ(map.palette.materials, (std::vector<MaterialInterval>{{0, 0, entries}}));
      EXPECT_EQ(map.palette.space, NormalSpace::kTangent);
      ASSERT_EQ(int(map.palette.normals.size()), entries);
      const Palette down = read_palette(dir / "f.png", GreenAxis::kDown);
      for (int i = 0; i < entries; i++) {
        EXPECT_LT(testing::angle_deg(map.palette.normals[i], normals[i]), 0.5);
        EXPECT_EQ(down.normals[i],
                  (Vec3f{map.palette.normals[i].x, -map.palette.normals[i].y, map.palette.normals[i].z}));
      }
    }
}

TEST(PaletteForeignPng, AnIndexBeyondThePalette) {
  const ScratchDir dir;
  write_foreign(dir / "f.png", 4, false, 4, {{128, 128, 255}, {0, 128, 128}, {255, 128, 128}}, {0, 1, 2, 9});
  EXPECT_ERROR(read_indexed_map(dir / "f.png"), ErrorKind::kMalformed, "f.png");
}

TEST(PaletteFile, ExrAndPng) {
  const ScratchDir dir;
  for (const int entries : {1, 5, 256, 3000}) {
    Palette palette = random_map(1, 1, entries, std::min(entries, 4)).palette;
    palette.space = NormalSpace::kObject;
    for (const char* file : {"p.exr", "p.png"}) {
      write_palette(dir / file, file_type_of(file), palette);
      EXPECT_FALSE(is_indexed_map(dir / file));
      const Palette back = read_palette(dir / file);
      EXPECT_EQ(back.normals, palette.normals) << file;
      EXPECT_EQ(back.materials, palette.materials) << file;
      EXPECT_EQ(back.space, palette.space) << file;
      // The same file as an image: N × 1 normals.
      const ImageReader image(dir / file);
      EXPECT_EQ(image.width(), entries);
      EXPECT_EQ(image.height(), 1);
      EXPECT_EQ(image.channels(), 3);
    }
  }
}

TEST(PaletteFile, AnyImageOneTexelHigh) {
  const ScratchDir dir;
  Random random(3);
  const std::vector<Vec3f> normals = random.directions(77);
  struct Case {
    const char* file;
    SampleType sample;
    double within_deg;
  };
  for (const Case& c : {Case{"p.png", SampleType::kUint8, 0.5}, Case{"p.tga", SampleType::kUint8, 0.5},
                        Case{"p.tif", SampleType::kUint16, 0.003}, Case{"p.exr", SampleType::kHalf, 0.05},
                        Case{"p.exr", SampleType::kFloat, 1e-4}})
    for (const bool down : {false, true}) {
      testing::write_normals(dir / c.file, c.sample, 77, 1, normals, down);
      const Palette palette = read_palette(dir / c.file, down ? GreenAxis::kDown : GreenAxis::kUp);
      ASSERT_EQ(palette.normals.size(), 77u);
      EXPECT_EQ(palette.materials, (std::vector<MaterialInterval>{{0, 0, 77}}));
      for (int i = 0; i < 77; i++)
        EXPECT_LT(testing::angle_deg(palette.normals[i], normals[i]), c.within_deg) << c.file;
    }
  testing::write_normals(dir / "two.png", SampleType::kUint8, 7, 2, testing::bumpy_normals(7, 2));
  EXPECT_ERROR(read_palette(dir / "two.png"), ErrorKind::kMalformed, "N x 1");
  write_bytes(dir / "text.png", "not an image");
  EXPECT_ERROR(read_palette(dir / "text.png"), ErrorKind::kMalformed, "text.png");
  EXPECT_ERROR(read_palette(dir / "none.png"), ErrorKind::kIo, "none.png");
}

TEST(PaletteIndexedMap, WhatIsNoIndexedMapSaysSo) {
  const ScratchDir dir;
  testing::write_normals(dir / "n.png", SampleType::kUint8, 4, 4, testing::bumpy_normals(4, 4));
  testing::write_normals(dir / "n.exr", SampleType::kHalf, 4, 4, testing::bumpy_normals(4, 4));
  testing::write_normals(dir / "n.tif", SampleType::kUint16, 4, 4, testing::bumpy_normals(4, 4));
  for (const char* file : {"n.png", "n.exr", "n.tif"}) {
    EXPECT_FALSE(is_indexed_map(dir / file));
    EXPECT_ERROR(read_indexed_map(dir / file), ErrorKind::kMalformed, "expected an indexed normal map");
  }
  EXPECT_ERROR(read_indexed_map(dir / "none.png"), ErrorKind::kIo, "none.png");
  EXPECT_ERROR(read_indexed_map(dir.path()), ErrorKind::kIo, dir.path());
  write_bytes(dir / "empty.png", "");
  EXPECT_ERROR(read_indexed_map(dir / "empty.png"), ErrorKind::kMalformed, "empty.png");
}

// The writers write what they are given, so that they can make what the readers must refuse.
TEST(PaletteMalformed, IntervalsAndIndices) {
  const ScratchDir dir;
  for (const int entries : {10, 400})
    for (const char* file : {"m.exr", "m.png"}) {
      const FileType type = file_type_of(file);
      const IndexedMap good = random_map(8, 8, entries, 1);
      const auto refused = [&](std::vector<MaterialInterval> materials) {
        IndexedMap bad = good;
        bad.palette.materials = std::move(materials);
        write_indexed_map(dir / file, type, bad);
        EXPECT_ERROR(read_indexed_map(dir / file), ErrorKind::kMalformed, "intervals");
        write_palette(dir / file, type, bad.palette);
        EXPECT_ERROR(read_palette(dir / file), ErrorKind::kMalformed, "intervals");
      };
      refused({{0, 0, 6}, {1, 5, entries - 5}});    // overlap
      refused({{0, 0, 4}, {1, 5, entries - 5}});    // a gap
      refused({{0, 0, 4}, {1, 4, entries - 5}});    // the end missing
      refused({{0, 0, 4}, {1, 4, entries - 3}});    // beyond the end
      refused({{0, 0, 4}, {0, 4, entries - 4}});    // one id twice
      refused({{1, 4, entries - 4}, {0, 0, 4}});    // another order
      refused({{0, 0, 0}, {1, 0, entries}});        // an empty one
      refused({{0, 0, -1}, {1, -1, entries + 1}});  // a negative one
      refused({{256, 0, entries}});                 // an id beyond 8 bits
      refused({{-1, 0, entries}});
      refused({{0, 1, entries - 1}});
      refused({});
      refused({{0, 0, std::numeric_limits<int>::max()}});
      IndexedMap bad = good;
      bad.levels[0].data[17] = std::uint16_t(entries);
      if (entries < 256 && type == FileType::kPng) continue;  // libpng would not write it; see AnIndexBeyondThePalette
      write_indexed_map(dir / file, type, bad);
      EXPECT_ERROR(read_indexed_map(dir / file), ErrorKind::kMalformed,
                   "expected indices below " + std::to_string(entries));
    }
}

TEST(PaletteMalformed, EntriesThatAreNoDirections) {
  const ScratchDir dir;
  for (const Vec3f bad : {Vec3f{0, 0, 0}, Vec3f{1e-5f, 0, 0}, Vec3f{std::numeric_limits<float>::infinity(), 0, 0},
                          Vec3f{0, std::numeric_limits<float>::quiet_NaN(), 0}}) {
    IndexedMap map = random_map(4, 4, 10, 1);
    map.palette.normals[3] = bad;
    write_indexed_map(dir / "m.exr", FileType::kExr, map);
    EXPECT_ERROR(read_indexed_map(dir / "m.exr"), ErrorKind::kMalformed, "m.exr");
  }
  // Not unit, but a direction: it is made so.
  IndexedMap map = random_map(4, 4, 10, 1);
  map.palette.normals[3] = {0, 3, 4};
  write_indexed_map(dir / "m.exr", FileType::kExr, map);
  const Vec3f back = read_indexed_map(dir / "m.exr").palette.normals[3];
  EXPECT_FLOAT_EQ(back.y, 0.6f);
  EXPECT_FLOAT_EQ(back.z, 0.8f);
}

struct RawExr {
  int width = 4, height = 4;
  std::vector<float> palette{0, 0, 1, 1, 0, 0};
  std::string materials = R"([{"id":0,"first":0,"count":2}])", space = "tangent";
  bool with_palette = true;
  std::uint32_t index = 1;
  Imf::PixelType channel = Imf::UINT;

  void write(const std::string& path) const {
    Imf::Header header(width, height);
    header.channels().insert("index", Imf::Channel(channel));
    if (with_palette) header.insert("burnish:palette", Imf::FloatVectorAttribute(palette));
    header.insert("burnish:materials", Imf::StringAttribute(materials));
    header.insert("burnish:space", Imf::StringAttribute(space));
    Imf::OutputFile out(path.c_str(), header);
    const std::vector<std::uint32_t> data(std::size_t(width) * height, index);
    Imf::FrameBuffer buffer;
    buffer.insert("index",
                  Imf::Slice(channel, reinterpret_cast<char*>(const_cast<std::uint32_t*>(data.data())), 4, 4 * width));
    out.setFrameBuffer(buffer);
    out.writePixels(height);
  }
};

TEST(PaletteMalformed, AttributesOfExr) {
  const ScratchDir dir;
  const std::string path = dir / "m.exr";
  RawExr().write(path);
  EXPECT_EQ(read_indexed_map(path).levels[0].data[5], 1);
  const auto refused = [&](const RawExr& raw) {
    raw.write(path);
    EXPECT_ERROR(read_indexed_map(path), ErrorKind::kMalformed, "m.exr");
  };
  RawExr raw;
  raw.palette.pop_back();
  refused(raw);
  raw.palette.clear();
  refused(raw);
  raw = {};
  raw.with_palette = false;
  refused(raw);
  raw = {};
  for (const std::uint32_t index : {2u, 65535u, 65536u, 65537u, 0xffffffffu}) {
    raw.index = index;
    refused(raw);
  }
  raw = {};
  raw.space = "world";
  refused(raw);
  raw = {};
  for (const char* json : {"", "null", "0", "[", "{}", "[{}]", "[1]", "[[]]", R"([{"id":0,"first":0}])", "\"text\"",
                           R"([{"id":"a","first":0,"count":2}])", R"([{"id":null,"first":0,"count":2}])",
                           R"([{"id":0,"first":0,"count":4294967298}])", R"([{"id":0,"first":0,"count":2.5}])",
                           R"([{"id":0,"first":0,"count":1e300}])", "[{\"id\":\xff,\"first\":0,\"count\":2}]"}) {
    raw.materials = json;
    raw.write(path);
    SCOPED_TRACE(json);
    EXPECT_ERROR(read_indexed_map(path), ErrorKind::kMalformed, "m.exr");
  }
  raw.materials = std::string(100000, '[');
  refused(raw);
}

TEST(PaletteMalformed, TruncatedAndDamagedFiles) {
  const ScratchDir dir;
  IndexedMap chain = random_map(100, 70, 40, 2), large = random_map(40, 30, 400, 1);
  write_indexed_map(dir / "large.png", FileType::kPng, large);
  write_indexed_map(dir / "large.exr", FileType::kExr, large);
  write_indexed_map(dir / "small.png", FileType::kPng, chain);
  write_palette(dir / "palette.png", FileType::kPng, chain.palette);
  write_palette(dir / "palette.exr", FileType::kExr, chain.palette);
  build_index_mips(chain, {});
  write_indexed_map(dir / "chain.exr", FileType::kExr, chain);
  Random random(1);
  for (const char* file : {"large.png", "large.exr", "small.png", "palette.png", "palette.exr", "chain.exr"}) {
    const std::string good = bytes_of(dir / file),
                      path = dir / ("bad" + std::string(file).substr(std::strlen(file) - 4));
    expect_survival(dir / file);
    for (std::size_t n = 0; n < good.size(); n += 97) {
      write_bytes(path, good.substr(0, n));
      SCOPED_TRACE(std::string(file) + " cut to " + std::to_string(n) + " bytes");
      expect_survival(path);
    }
    for (int flip = 0; flip < 300; flip++) {
      std::string bad = good;
      // The head is where sizes and lengths are.
      const std::size_t at =
          std::size_t(random.below(int(flip % 2 ? std::min<std::size_t>(good.size(), 500) : good.size())));
      bad[at] = char(bad[at] ^ (1 << random.below(8)));
      write_bytes(path, bad);
      SCOPED_TRACE(std::string(file) + " with a bit changed at " + std::to_string(at));
      expect_survival(path);
    }
  }
}

void append_chunk(std::string& png, const std::string& type, const std::string& data) {
  const auto number = [&](std::uint32_t n) {
    for (int shift : {24, 16, 8, 0}) png += char(n >> shift);
  };
  number(std::uint32_t(data.size()));
  png += type + data;
  std::uint32_t crc = 0xffffffffu;
  for (const char c : type + data) {
    crc ^= std::uint8_t(c);
    for (int bit = 0; bit < 8; bit++) crc = crc & 1 ? 0xedb88320u ^ crc >> 1 : crc >> 1;
  }
  number(~crc);
}

TEST(PaletteMalformed, AHugeSizeInASmallFileAsksForNoMemory) {
  const ScratchDir dir;
  const long before = peak_mib();
  for (const std::uint32_t side : {60000u, 200000u, 1000000u, 0x7fffffffu}) {
    std::string png = "\x89PNG\r\n\x1a\n", size;
    for (int shift : {24, 16, 8, 0}) size += char(side >> shift);
    append_chunk(png, "IHDR", size + size + std::string("\x08\x03\0\0\0", 5));
    append_chunk(png, "PLTE", std::string(6, '\x80'));
    append_chunk(png, "IDAT", std::string("\x78\x9c\x03\0\0\0\0\x01", 8));
    append_chunk(png, "IEND", "");
    write_bytes(dir / "huge.png", png);
    SCOPED_TRACE("PNG of " + std::to_string(side));
    expect_survival(dir / "huge.png");
    EXPECT_ERROR(read_indexed_map(dir / "huge.png"), ErrorKind::kMalformed, "huge.png");
  }
  // dataWindow's maximum, in a file that holds 4 × 4 texels.
  RawExr().write(dir / "good.exr");
  const std::string good = bytes_of(dir / "good.exr");
  const std::size_t window = good.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
  for (const std::uint32_t side : {60000u, 200000u, 1000000u, 0x7fffffffu}) {
    std::string bad = good;
    for (const std::size_t corner : {std::size_t(8), std::size_t(12)})
      for (int i = 0; i < 4; i++) bad[window + corner + i] = char((side - 1) >> (8 * i));
    write_bytes(dir / "huge.exr", bad);
    SCOPED_TRACE("EXR of " + std::to_string(side));
    expect_survival(dir / "huge.exr");
    EXPECT_ERROR(read_indexed_map(dir / "huge.exr"), ErrorKind::kMalformed, "huge.exr");
  }
  EXPECT_LT(peak_mib() - before, 600);
}

}  // namespace
}  // namespace burnish
