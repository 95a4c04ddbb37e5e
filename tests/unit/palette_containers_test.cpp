#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "burnish/palette/index_mips.h"
#include "burnish/palette/indexed_map.h"
#include "dds_reader.h"
#include "expect_error.h"
#include "indexed_map_checks.h"
#include "ktx2_reader.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::expect_same;
using testing::expect_survival;
using testing::random_map;
using testing::read_dds;
using testing::read_ktx2;
using testing::ScratchDir;
using testing::write_bytes;

IndexedMap random_chain(int width, int height, int entries, int materials) {
  IndexedMap map = random_map(width, height, entries, materials);
  map.levels[0].data.back() = std::uint16_t(entries - 1);
  map.palette.space = materials == 1 ? NormalSpace::kObject : NormalSpace::kTangent;
  build_index_mips(map, {});
  return map;
}

// The palette of a DDS beside it.
void write_beside(const ScratchDir& dir, const IndexedMap& map) {
  write_palette(dir / "p.exr", FileType::kExr, map.palette);
}

IndexedMap read_back(const ScratchDir& dir, const std::string& file) {
  const bool beside = file_type_of(file) == FileType::kDds;
  return read_indexed_map(dir / file, GreenAxis::kUp, beside ? FileRef(dir / "p.exr") : FileRef());
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, int count = 4) {
  for (int i = 0; i < count; i++) bytes[at + i] = char(value >> 8 * i);
}

TEST(PaletteContainers, ComeBackAsTheyWentIn) {
  const ScratchDir dir;
  for (const int entries : {1, 2, 3, 255, 256, 257, 5000, 65536})
    for (const int materials : {1, 3}) {
      if (materials > entries) continue;
      const IndexedMap map = random_chain(67, 45, entries, materials);
      write_beside(dir, map);
      for (const char* file : {"m.ktx2", "m.dds"}) {
        SCOPED_TRACE(std::string(file) + " of " + std::to_string(entries));
        write_indexed_map(dir / file, file_type_of(file), map);
        EXPECT_TRUE(is_indexed_map(dir / file));
        expect_same(map, read_back(dir, file));
        const std::string bytes = bytes_of(dir / file);
        write_indexed_map(dir / file, file_type_of(file), map);
        EXPECT_EQ(bytes, bytes_of(dir / file)) << "written twice";
      }
      EXPECT_EQ(read_palette(dir / "m.ktx2").normals, map.palette.normals);
      EXPECT_EQ(read_palette(dir / "m.ktx2").materials, map.palette.materials);
    }
}

TEST(PaletteContainers, EverySizeAndNumberOfLevels) {
  const ScratchDir dir;
  for (const auto& [width, height] : {std::pair(64, 64), std::pair(256, 32), std::pair(333, 77), std::pair(1, 9),
                                      std::pair(5, 3), std::pair(129, 200), std::pair(1, 1)})
    for (const int entries : {16, 300}) {
      IndexedMap map = random_chain(width, height, entries, 2);
      write_beside(dir, map);
      for (; !map.levels.empty(); map.levels.pop_back())
        for (const char* file : {"m.ktx2", "m.dds"}) {
          SCOPED_TRACE(std::string(file) + " of " + std::to_string(width) + "x" + std::to_string(height) + ", " +
                       std::to_string(map.levels.size()) + " levels");
          write_indexed_map(dir / file, file_type_of(file), map);
          expect_same(map, read_back(dir, file));
        }
    }
}

TEST(PaletteContainers, Ktx2IsWhatTheSpecificationSays) {
  const ScratchDir dir;
  for (const int entries : {1, 2, 255, 256, 257, 300, 65536})
    for (const auto& [width, height] : {std::pair(67, 45), std::pair(1, 1), std::pair(3, 1), std::pair(2, 64)}) {
      SCOPED_TRACE(std::to_string(entries) + " entries, " + std::to_string(width) + "x" + std::to_string(height));
      const IndexedMap map = random_chain(width, height, entries, std::min(entries, 3));
      write_indexed_map(dir / "m.ktx2", FileType::kKtx2, map);
      const testing::Ktx2 k = read_ktx2(bytes_of(dir / "m.ktx2"));
      EXPECT_EQ(k.format, entries <= 256 ? 13u : 74u);
      EXPECT_EQ(k.width, std::uint32_t(width));
      EXPECT_EQ(k.height, std::uint32_t(height));
      ASSERT_EQ(k.levels.size(), map.levels.size());
      for (std::size_t l = 0; l < k.levels.size(); l++) EXPECT_EQ(k.levels[l], map.levels[l].data) << "level " << l;
      const std::string nul(1, '\0');
      EXPECT_EQ(k.value("KTXorientation"), "rd" + nul);
      EXPECT_TRUE(k.value("KTXwriter").starts_with("burnish ") && k.value("KTXwriter").ends_with('\0'));
      EXPECT_EQ(k.value("burnish:format"), "1" + nul);
      EXPECT_EQ(k.value("burnish:y"), "up" + nul);
      EXPECT_EQ(k.value("burnish:space"), (entries == 1 ? "object" : "tangent") + nul);
      const std::string& palette = k.value("burnish:palette");
      ASSERT_EQ(palette.size(), std::size_t(entries) * 12);
      EXPECT_EQ(0, std::memcmp(palette.data(), map.palette.normals.data(), palette.size()));
      const std::string& materials = k.value("burnish:materials");
      ASSERT_TRUE(materials.ends_with('\0'));
      const nlohmann::json json = nlohmann::json::parse(materials.substr(0, materials.size() - 1));
      ASSERT_EQ(json.size(), map.palette.materials.size());
      for (std::size_t i = 0; i < json.size(); i++)
        EXPECT_EQ(json[i], (nlohmann::json{{"id", map.palette.materials[i].id},
                                           {"first", map.palette.materials[i].first},
                                           {"count", map.palette.materials[i].count}}));
    }
}

TEST(PaletteContainers, DdsIsWhatItsStructuresSay) {
  const ScratchDir dir;
  for (const int entries : {1, 2, 255, 256, 257, 300, 65536})
    for (const auto& [width, height] : {std::pair(67, 45), std::pair(1, 1), std::pair(3, 1), std::pair(2, 64)}) {
      SCOPED_TRACE(std::to_string(entries) + " entries, " + std::to_string(width) + "x" + std::to_string(height));
      const IndexedMap map = random_chain(width, height, entries, 1);
      write_indexed_map(dir / "m.dds", FileType::kDds, map);
      const testing::Dds d = read_dds(bytes_of(dir / "m.dds"));
      EXPECT_EQ(d.start.dxt10.dxgi_format, entries <= 256 ? 62u : 57u);
      EXPECT_EQ(d.start.header.width, std::uint32_t(width));
      EXPECT_EQ(d.start.header.height, std::uint32_t(height));
      ASSERT_EQ(d.levels.size(), map.levels.size());
      for (std::size_t l = 0; l < d.levels.size(); l++) EXPECT_EQ(d.levels[l], map.levels[l].data) << "level " << l;
    }
}

TEST(PaletteContainers, APaletteBesideIsForFilesWithout) {
  const ScratchDir dir;
  const IndexedMap map = random_chain(16, 8, 20, 2);
  write_beside(dir, map);
  for (const char* file : {"m.dds", "m.ktx2", "m.exr"}) write_indexed_map(dir / file, file_type_of(file), map);
  EXPECT_ERROR(read_indexed_map(dir / "m.dds"), ErrorKind::kUsage, "holds indices only");
  EXPECT_ERROR(read_palette(dir / "m.dds"), ErrorKind::kMalformed, "expected a palette");
  for (const char* file : {"m.ktx2", "m.exr"})
    EXPECT_ERROR(read_indexed_map(dir / file, GreenAxis::kUp, dir / "p.exr"), ErrorKind::kUsage, "its own palette");
  // From a PNG, from an indexed map; a plain image has no materials, and its green may point down.
  write_palette(dir / "p.png", FileType::kPng, map.palette);
  for (const char* palette : {"p.png", "m.ktx2", "m.exr"})
    expect_same(map, read_indexed_map(dir / "m.dds", GreenAxis::kUp, dir / palette));
  testing::write_normals(dir / "plain.exr", SampleType::kFloat, 20, 1, map.palette.normals, true);
  const IndexedMap plain = read_indexed_map(dir / "m.dds", GreenAxis::kDown, dir / "plain.exr");
  EXPECT_EQ(plain.palette.materials, (std::vector<MaterialInterval>{{0, 0, 20}}));
  for (int i = 0; i < 20; i++) EXPECT_LT(testing::angle_deg(plain.palette.normals[i], map.palette.normals[i]), 1e-3);
  EXPECT_EQ(plain.levels[0].data, map.levels[0].data);
  testing::write_normals(dir / "short.exr", SampleType::kFloat, 5, 1, testing::bumpy_normals(5, 1));
  EXPECT_ERROR(read_indexed_map(dir / "m.dds", GreenAxis::kUp, dir / "short.exr"), ErrorKind::kMalformed,
               "expected indices below 5");
  EXPECT_ERROR(read_indexed_map(dir / "m.dds", GreenAxis::kUp, dir / "none.exr"), ErrorKind::kIo, "none.exr");
}

// As others write them: without our keys, without the levels' number, in another order, with flags that say little.
TEST(PaletteContainers, ForeignFiles) {
  const ScratchDir dir;
  const IndexedMap map = random_chain(4, 4, 9, 1);
  write_beside(dir, map);
  std::string ktx2 = "\xabKTX 20\xbb\r\n\x1a\n";
  ktx2.resize(80 + 3 * 24);
  for (const auto& [at, value] : std::initializer_list<std::pair<int, int>>{
           {12, 74}, {16, 2}, {20, 4}, {24, 4}, {36, 1}, {40, 3}, {80, 152}, {104, 184}, {128, 192}})
    put(ktx2, at, value);
  for (const int l : {0, 1, 2}) {
    const int size = 2 * int(map.levels[l].texels());
    put(ktx2, 88 + 24 * l, size, 8), put(ktx2, 96 + 24 * l, size, 8);
    for (const std::uint16_t i : map.levels[l].data) ktx2 += char(i), ktx2 += '\0';
  }
  write_bytes(dir / "f.ktx2", ktx2);
  EXPECT_TRUE(is_indexed_map(dir / "f.ktx2"));
  IndexedMap expected = map;
  expected.palette.space = NormalSpace::kObject;
  expect_same(expected, read_indexed_map(dir / "f.ktx2", GreenAxis::kUp, dir / "p.exr"));
  EXPECT_ERROR(read_indexed_map(dir / "f.ktx2"), ErrorKind::kUsage, "holds indices only");
  EXPECT_ERROR(read_palette(dir / "f.ktx2"), ErrorKind::kMalformed, "expected a palette");
  put(ktx2, 40, 0);  // one level, the others to be made by whoever reads it
  write_bytes(dir / "f.ktx2", ktx2);
  expected.levels.resize(1);
  expect_same(expected, read_indexed_map(dir / "f.ktx2", GreenAxis::kUp, dir / "p.exr"));

  std::string dds = "DDS ";
  dds.resize(148);
  for (const auto& [at, value] : std::initializer_list<std::pair<int, int>>{
           {4, 124}, {12, 4}, {16, 4}, {76, 32}, {80, 4}, {84, 0x30315844}, {128, 62}, {132, 3}, {140, 1}})
    put(dds, at, value);
  for (const std::uint16_t i : map.levels[0].data) dds += char(i);
  write_bytes(dir / "f.dds", dds);
  EXPECT_TRUE(is_indexed_map(dir / "f.dds"));
  expect_same(expected, read_indexed_map(dir / "f.dds", GreenAxis::kUp, dir / "p.exr"));
}

struct Change {
  std::size_t at;
  std::uint64_t value;
  ErrorKind kind;
  const char* message;
};

void expect_refused(const ScratchDir& dir, const std::string& file, const std::vector<Change>& changes) {
  const std::string good = bytes_of(dir / file);
  for (const Change& c : changes) {
    std::string bad = good;
    put(bad, c.at, c.value);
    const std::string name = "bad-" + file;
    write_bytes(dir / name, bad);
    SCOPED_TRACE(file + " with " + std::to_string(c.value) + " at " + std::to_string(c.at));
    EXPECT_ERROR(read_back(dir, name), c.kind, c.message);
    EXPECT_ERROR(read_back(dir, name), c.kind, name);
    EXPECT_EQ(is_indexed_map(dir / name),
              c.kind != ErrorKind::kUnsupported || std::strstr(c.message, "FORMAT") == nullptr);
  }
}

TEST(PaletteContainersMalformed, FieldsOfKtx2) {
  const ScratchDir dir;
  write_indexed_map(dir / "m.ktx2", FileType::kKtx2, random_chain(16, 8, 20, 2));
  const auto unsupported = ErrorKind::kUnsupported, malformed = ErrorKind::kMalformed;
  expect_refused(dir, "m.ktx2",
                 {{12, 0, unsupported, "got VK_FORMAT_UNDEFINED"},
                  {12, 9, unsupported, "got VK_FORMAT_R8_UNORM"},
                  {12, 37, unsupported, "got VK_FORMAT_R8G8B8A8_UNORM"},
                  {12, 145, unsupported, "got VK_FORMAT_BC7_UNORM_BLOCK"},
                  {12, 98, unsupported, "got VK_FORMAT_R32_UINT"},
                  {12, 1000066013, unsupported, "got VK_FORMAT 1000066013"},
                  {12, 74, malformed, "bytes of 16x8 texels in level 0"},
                  {20, 0, malformed, "expected texels, got 0x8"},
                  {24, 0, malformed, "expected texels, got 16x0"},
                  {20, 0xffffffff, malformed, "expected texels"},
                  {20, 0x7fffffff, malformed, "bytes of"},
                  {20, 32, malformed, "bytes of 32x8 texels in level 0"},
                  {24, 9, malformed, "bytes of 16x9 texels in level 0"},
                  {28, 2, unsupported, "a volume"},
                  {32, 1, unsupported, "an array of 1"},
                  {36, 6, unsupported, "one face, got 6"},
                  {36, 0, unsupported, "one face, got 0"},
                  {40, 6, malformed, "at most 5 levels of 16x8 texels, got 6"},
                  {40, 0xffffffff, malformed, "at most 5 levels"},
                  {44, 2, unsupported, "Zstandard"},
                  {44, 3, unsupported, "ZLIB"},
                  {44, 77, unsupported, "scheme 77"},
                  {56, 0xfffffff0, malformed, "too short for its keys and values"},
                  {60, 0xfffffff0, malformed, "too short for its keys and values"},
                  {60, 0, ErrorKind::kUsage, "holds indices only"},
                  {60, 3, malformed, "damaged"},
                  {80, 0x7fffffff, malformed, "too short for 16x8 texels"},
                  {84, 0xffffffff, malformed, "too short for 16x8 texels"},
                  {88, 127, malformed, "expected 128 bytes of 16x8 texels in level 0, got 127"},
                  {112, 0xffffffff, malformed, "in level 1"}});
}

TEST(PaletteContainersMalformed, KeysAndValuesOfKtx2) {
  const ScratchDir dir;
  write_indexed_map(dir / "m.ktx2", FileType::kKtx2, random_chain(16, 8, 20, 2));
  const std::string good = bytes_of(dir / "m.ktx2");
  const auto refused = [&](const std::string& from, const std::string& to, ErrorKind kind, const std::string& message) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    ASSERT_EQ(from.size(), to.size());
    write_bytes(dir / "bad.ktx2", bad.replace(at, to.size(), to));
    SCOPED_TRACE(from + " as " + to);
    EXPECT_ERROR(read_indexed_map(dir / "bad.ktx2"), kind, message);
  };
  using std::string_literals::operator""s;
  refused("rd\0"s, "ru\0"s, ErrorKind::kUnsupported, "KTXorientation rd, got 'ru'");
  refused("rd\0"s, "r\n\0"s, ErrorKind::kUnsupported, "KTXorientation rd, got 'r?'");
  refused("format\0001"s, "format\0002"s, ErrorKind::kUnsupported, "burnish:format 1, got '2'");
  refused("space\0tangent"s, "space\0tangens"s, ErrorKind::kMalformed, "tangent or object");
  refused("\"first\":10", "\"first\":11", ErrorKind::kMalformed, "intervals");
  refused("[{\"id\"", "[{\"ie\"", ErrorKind::kMalformed, "burnish:materials");
  refused("burnish:palette", "burnish:pallete", ErrorKind::kUsage, "holds indices only");
  // Lengths that end inside the palette, beyond the data, before a key's NUL.
  const std::size_t palette = good.find("burnish:palette") - 4;
  for (const std::uint32_t length : {0u, 1u, 15u, 16u, 17u, 27u, 255u, 257u, 100000u, 0xffffffffu}) {
    std::string bad = good;
    put(bad, palette, length);
    write_bytes(dir / "bad.ktx2", bad);
    SCOPED_TRACE(length);
    EXPECT_ERROR(read_indexed_map(dir / "bad.ktx2"), ErrorKind::kMalformed, "bad.ktx2");
  }
  for (const std::string& bits :
       {"\0\0\0\0\0\0\0\0\0\0\0\0"s, "\0\0\xc0\x7f\0\0\0\0\0\0\0\0"s, "\0\0\x80\x7f\0\0\0\0\0\0\0\0"s}) {
    std::string bad = good;
    write_bytes(dir / "bad.ktx2", bad.replace(palette + 4 + 16, 12, bits));
    EXPECT_ERROR(read_indexed_map(dir / "bad.ktx2"), ErrorKind::kMalformed, "unit normals");
  }
  std::string bad = good;
  bad.back() = 20;
  write_bytes(dir / "bad.ktx2", bad);
  EXPECT_ERROR(read_indexed_map(dir / "bad.ktx2"), ErrorKind::kMalformed,
               "expected indices below 20, got 20 in level 0");
  EXPECT_ERROR(read_palette(dir / "bad.ktx2"), ErrorKind::kMalformed, "expected indices below 20");
}

TEST(PaletteContainersMalformed, FieldsOfDds) {
  const ScratchDir dir;
  const IndexedMap map = random_chain(16, 8, 20, 2);
  write_beside(dir, map);
  write_indexed_map(dir / "m.dds", FileType::kDds, map);
  const auto unsupported = ErrorKind::kUnsupported, malformed = ErrorKind::kMalformed;
  expect_refused(dir, "m.dds",
                 {{12, 0, malformed, "expected texels, got 16x0"},
                  {16, 0, malformed, "expected texels, got 0x8"},
                  {16, 0x80000000, malformed, "expected texels"},
                  {16, 0x7fffffff, malformed, "too short for 2147483647x8 texels"},
                  {16, 32, malformed, "too short for 32x8 texels"},
                  {28, 6, malformed, "at most 5 levels of 16x8 texels, got 6"},
                  {28, 0xffffffff, malformed, "at most 5 levels"},
                  {128, 57, malformed, "too short"},
                  {128, 61, unsupported, "got DXGI_FORMAT_R8_UNORM"},
                  {128, 28, unsupported, "got DXGI_FORMAT_R8G8B8A8_UNORM"},
                  {128, 98, unsupported, "got DXGI_FORMAT_BC7_UNORM"},
                  {128, 132, unsupported, "got DXGI_FORMAT 132"}});
  const std::string good = bytes_of(dir / "m.dds");
  const auto refused = [&](std::size_t at, std::uint32_t value, ErrorKind kind, const std::string& message) {
    std::string bad = good;
    put(bad, at, value);
    write_bytes(dir / "bad.dds", bad);
    SCOPED_TRACE(std::to_string(value) + " at " + std::to_string(at));
    EXPECT_FALSE(is_indexed_map(dir / "bad.dds"));
    EXPECT_ERROR(read_back(dir, "bad.dds"), kind, message);
  };
  refused(4, 123, malformed, "damaged");
  refused(76, 24, malformed, "damaged");
  refused(84, 0x31545844, unsupported, "got FourCC 'DXT1'");
  refused(84, 113, unsupported, "got D3DFORMAT 113");
  refused(80, 0x41, unsupported, "0 bits a texel and no DX10 header");
  refused(112, 0xfe00, unsupported, "a cube, volume or line");
  refused(112, 0x200000, unsupported, "a cube, volume or line");
  refused(132, 2, unsupported, "a cube, volume or line");
  refused(132, 4, unsupported, "a cube, volume or line");
  refused(136, 4, unsupported, "a cube, volume or line");
  refused(140, 0, unsupported, "an array of 0");
  refused(140, 6, unsupported, "an array of 6");
}

TEST(PaletteContainersMalformed, EveryTruncationIsSeen) {
  const ScratchDir dir;
  for (const int entries : {40, 400}) {
    const IndexedMap map = random_chain(50, 35, entries, 2);
    write_beside(dir, map);
    for (const char* file : {"m.ktx2", "m.dds"}) {
      write_indexed_map(dir / file, file_type_of(file), map);
      const std::string good = bytes_of(dir / file), name = std::string("cut-") + file;
      for (std::size_t n = 0; n < good.size(); n += 16) {
        write_bytes(dir / name, good.substr(0, n));
        SCOPED_TRACE(std::string(file) + " cut to " + std::to_string(n) + " bytes");
        EXPECT_ERROR(read_back(dir, name), ErrorKind::kMalformed, name);
        expect_survival(dir / name);
      }
      write_bytes(dir / name, good.substr(0, good.size() - 1));
      EXPECT_ERROR(read_back(dir, name), ErrorKind::kMalformed, name);
    }
  }
}

// Whatever one byte of a header says: an error of ours, or a map that fits; and no memory for what a file cannot hold.
TEST(PaletteContainersMalformed, EveryByteOfAHeader) {
  const ScratchDir dir;
  const long before = testing::peak_mib();
  const IndexedMap map = random_chain(13, 6, 40, 2);
  write_beside(dir, map);
  for (const char* file : {"m.ktx2", "m.dds"}) {
    write_indexed_map(dir / file, file_type_of(file), map);
    const std::string good = bytes_of(dir / file), name = std::string("bad-") + file;
    const std::size_t header = file_type_of(file) == FileType::kDds ? 148 : good.size() - 13 * 6;
    for (std::size_t at = 0; at < header; at++)
      for (const int flip : {0x01, 0x80, 0xff}) {
        std::string bad = good;
        bad[at] = char(bad[at] ^ flip);
        write_bytes(dir / name, bad);
        SCOPED_TRACE(std::string(file) + " with byte " + std::to_string(at) + " changed by " + std::to_string(flip));
        expect_survival(dir / name);
        try {
          const IndexedMap back = read_back(dir, name);
          for (const IndexImage& level : back.levels)
            EXPECT_LE(level.texels() ? *std::ranges::max_element(level.data) : 0, int(back.palette.normals.size()) - 1);
        } catch (const Error& e) {
          EXPECT_NE(int(e.kind()), int(ErrorKind::kInternal)) << e.what();
        }
      }
  }
  EXPECT_LT(testing::peak_mib() - before, 200);
}

TEST(PaletteContainers, NormalsWhoseYIsDownAreNoneOfOurs) {
  const ScratchDir dir;
  const IndexedMap map = random_chain(8, 8, 12, 1);
  for (const auto& [file, key] : {std::pair("m.ktx2", std::string("burnish:y\0up", 12)),
                                  {"m.exr", std::string("burnish:y\0string\0\2\0\0\0up", 23)}}) {
    write_indexed_map(dir / file, file_type_of(file), map);
    std::string bytes = bytes_of(dir / file);
    const std::size_t at = bytes.find(key);
    ASSERT_NE(at, std::string::npos) << file;
    bytes.replace(at + key.size() - 2, 2, "dn");
    write_bytes(dir / file, bytes);
    EXPECT_ERROR(read_indexed_map(dir / file, GreenAxis::kUp), ErrorKind::kUnsupported,
                 "expected normals with burnish:y up, got 'dn'");
  }
}

TEST(PaletteContainers, AFullDiskIsAnIoError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const int side : {4, 900})
    for (const FileType type : {FileType::kKtx2, FileType::kDds})
      EXPECT_ERROR(write_indexed_map("/dev/full", type, random_map(side, side, 300, 1)), ErrorKind::kIo,
                   "cannot be written");
}

TEST(PaletteContainers, AreNoImages) {
  const ScratchDir dir;
  const IndexedMap map = random_chain(8, 8, 20, 1);
  for (const char* file : {"m.ktx2", "m.dds"}) {
    const FileType type = file_type_of(file);
    write_indexed_map(dir / file, type, map);
    EXPECT_ERROR(ImageReader(dir / file), ErrorKind::kUnsupported, std::string("got a ") + name(type));
    for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat})
      EXPECT_ERROR(write_image(dir / "x", type, sample, Image(4, 4, 3)), ErrorKind::kUnsupported,
                   std::string(name(type)) + " is written for indexed normal maps only");
    EXPECT_FALSE(std::filesystem::exists(dir / "x"));
  }
}

}  // namespace
}  // namespace burnish
