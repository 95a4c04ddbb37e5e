// Histograms as files: what is written is read back, added-up files are as all maps at once, and every lie is refused.
#include <gtest/gtest.h>
#include <zlib.h>

#include "burnish/core/whole_file.h"
#include "burnish/palette/files/histogram_file.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/shared_palette.h"
#include "damaged.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;
using Numbers = std::vector<std::uint64_t>;

constexpr int kW = 70, kH = 50;

// A map with materials and a mask, in which material 7 counts nowhere.
MapFiles make_map(const ScratchDir& dir, const std::string& stem, const std::string& file, SampleType sample,
                  std::uint32_t seed, bool green_down = false, int w = kW, int h = kH) {
  Random random(seed);
  std::vector<int> ids, mask;
  for (int i = 0; i < w * h; i++) {
    ids.push_back(random.below(10) == 0 ? 7 : random.below(3));
    mask.push_back(ids.back() != 7 && random.below(4) ? 255 : 0);
  }
  write_normals(dir / file, sample, w, h, bumpy_normals(w, h, seed), green_down);
  write_ids(dir / (stem + "_ids.png"), w, h, ids);
  write_ids(dir / (stem + "_mask.png"), w, h, mask);
  return {dir / file, dir / (stem + "_ids.png"), dir / (stem + "_mask.png")};
}

NormalCounts count(const std::vector<MapFiles>& files, const NormalCoding& coding = {}) {
  MapSet maps(files, coding);
  NormalCounts counts;
  counts.add(maps);
  return counts;
}

// By way of a file.
NormalCounts count_apart(const ScratchDir& dir, const MapFiles& map, const NormalCoding& coding = {}) {
  count_maps({map}, coding, std::nullopt, dir / "one.histogram");
  return read_histogram(dir / "one.histogram").counts;
}

void expect_same(const NormalCounts& a, const NormalCounts& b) {
  EXPECT_EQ(a.texels().counted, b.texels().counted);
  EXPECT_EQ(a.texels().invalid, b.texels().invalid);
  const Histogram one = histogram_of(a), two = histogram_of(b);
  EXPECT_EQ(one.exact, two.exact);
  EXPECT_EQ(one.distinct, two.distinct);
  EXPECT_EQ(one.counts, two.counts);
  ASSERT_EQ(one.material, two.material);
  for (std::size_t g = 0; g < one.groups.size(); g++) {
    ASSERT_EQ(one.groups[g].size(), two.groups[g].size()) << "material " << one.material[g];
    for (std::size_t i = 0; i < one.groups[g].size(); i++) {
      ASSERT_EQ(one.groups[g][i].normal, two.groups[g][i].normal) << "material " << one.material[g];
      ASSERT_EQ(one.groups[g][i].weight, two.groups[g][i].weight) << "material " << one.material[g];
    }
  }
}

struct Stored {
  const char* file;
  SampleType sample;
};
const Stored kStored[] = {{"a.png", SampleType::kUint8},
                          {"b.tif", SampleType::kUint16},
                          {"c.exr", SampleType::kHalf},
                          {"d.exr", SampleType::kFloat}};

TEST(PaletteHistogramFile, IsReadBackAsItWasWritten) {
  const ScratchDir dir;
  for (const Stored& s : kStored)
    for (const char* channels : {"", "xy"})
      for (const GreenAxis green : {GreenAxis::kUp, GreenAxis::kDown}) {
        const NormalCoding coding{green, NormalEncoding::kByType, channels};
        const MapFiles map = make_map(dir, "m", s.file, s.sample, 1);
        SCOPED_TRACE(std::string(s.file) + " " + channels);
        const NormalCounts counts = count({map}, coding);
        EXPECT_TRUE(counts.exact());
        expect_same(count_apart(dir, map, coding), counts);
      }
}

TEST(PaletteHistogramFile, AddedUpTheyAreAsAllMapsAtOnce) {
  const ScratchDir dir;
  std::vector<MapFiles> maps;
  NormalCounts apart;
  for (const Stored& s : kStored) {
    maps.push_back(make_map(dir, std::string(1, s.file[0]), s.file, s.sample, std::uint32_t(s.file[0])));
    apart.add(count_apart(dir, maps.back()));
  }
  expect_same(apart, count(maps));
  const Histogram h = histogram_of(apart);
  EXPECT_EQ(h.material, (std::vector<int>{0, 1, 2, 7}));
  EXPECT_EQ(h.counts, (std::vector<char>{1, 1, 1, 0}));
}

// The same normals, whichever way they are stored.
TEST(PaletteHistogramFile, CodingsAreResolved) {
  const ScratchDir dir;
  for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat}) {
    const MapFiles up = make_map(dir, "up", "up.exr", sample, 5),
                   down = make_map(dir, "down", "down.exr", sample, 5, true);
    NormalCounts both = count_apart(dir, up);
    both.add(count_apart(dir, down, {GreenAxis::kDown, NormalEncoding::kByType, ""}));
    expect_same(both, count({up, up}));
  }
}

// Texel by texel.
NormalCounts in_bins(const std::vector<MapFiles>& files) {
  MapSet maps(files, {});
  NormalBins bins;
  for (std::size_t i = 0; i < maps.size(); i++) {
    OpenMap& map = maps.open(i);
    TexelRows rows;
    map.read_rows(0, map.height(), rows);
    bool invalid;
    for (int y = 0; y < map.height(); y++)
      for (int x = 0; x < map.width(); x++)
        bins.add(rows.material_at(x, y), rows.counts_at(x, y), TexelKeys::decode(rows.row(y)[x], invalid));
  }
  return {std::move(bins), 0};
}

// Directions, and some normals that come often, three times as often as others that share their bins.
std::vector<Vec3f> many_normals(Random& random, std::size_t n) {
  std::vector<Vec3f> normals = random.directions(n);
  for (Vec3f& v : normals)
    if (random.below(20) == 0) {
      const int k = random.below(40);
      v = Vec3f(normalized(Vec3d{0.1 * (k % 7) + 0.01, 0.07 * (k % 9) + (random.below(4) ? 0 : 1e-6), 1}));
    }
  return normals;
}

TEST(PaletteHistogramFile, TooManyNormalsAreTheBinsOfAllMaps) {
  const ScratchDir dir;
  const int w = 1024, h = 1100;  // 1.07 million each, of at most 2.1 million; the last by itself too many
  std::vector<MapFiles> maps;
  std::vector<NormalCounts> apart;
  Random random(3);
  for (const int times : {1, 1, 2}) {
    const std::string stem = std::to_string(maps.size());
    maps.push_back(make_map(dir, stem, stem + ".exr", SampleType::kFloat, std::uint32_t(times), false, w, times * h));
    write_normals(dir / (stem + ".exr"), SampleType::kFloat, w, times * h,
                  many_normals(random, std::size_t(w) * times * h));
    apart.push_back(count_apart(dir, maps.back()));
    EXPECT_EQ(apart.back().exact(), times == 1);
  }
  for (const auto& [i, j] : {std::pair(0, 1), {2, 0}, {2, 2}}) {
    SCOPED_TRACE(std::to_string(i) + " and " + std::to_string(j));
    NormalCounts both = apart[i];
    both.add(apart[j]);
    EXPECT_FALSE(both.exact());
    expect_same(both, in_bins({maps[i], maps[j]}));
  }
  expect_same(count({maps[0], maps[1]}), in_bins({maps[0], maps[1]}));
}

TEST(PaletteHistogramFile, ThePaletteIsTheOneOfAllMaps) {
  const ScratchDir dir;
  std::vector<MapFiles> maps;
  std::vector<FileRef> histograms;
  for (const Stored& s : kStored) {
    const std::string stem(1, s.file[0]);
    maps.push_back(make_map(dir, stem, s.file, s.sample, std::uint32_t(s.file[0])));
    histograms.push_back(dir / (stem + ".histogram"));
    count_maps({maps.back()}, {}, std::nullopt, histograms.back());
  }
  for (const auto& [engine, encoding, target] : {std::tuple(Engine::kSpherical, MaterialEncoding::kSplit, 0.),
                                                 {Engine::kSpherical, MaterialEncoding::kSplit, 4.},
                                                 {Engine::kMedianCut, MaterialEncoding::kAlpha, 0.},
                                                 {Engine::kSpherical, MaterialEncoding::kSubcubes, 0.}}) {
    QuantizeOptions options;
    options.normals = 90, options.engine = engine, options.encoding = encoding;
    if (target > 0) options.target_error_deg = target;
    const SharedPalette shared = fit_shared_palette(histograms, options, NormalSpace::kObject);
    options.space = NormalSpace::kObject;
    const QuantizeResult all = quantize_normal_maps(
        maps, options, [](std::size_t, const Palette&, int, int) { return [](int, const std::uint16_t*) {}; });
    EXPECT_EQ(shared.palette.normals, all.palette.normals);
    EXPECT_EQ(shared.palette.materials, all.palette.materials);
    EXPECT_EQ(shared.palette.space, NormalSpace::kObject);
    EXPECT_EQ(shared.stats.texels, all.stats.texels);
    EXPECT_EQ(shared.stats.normals, all.stats.normals);
    EXPECT_EQ(shared.stats.distinct_input_normals, all.stats.distinct_input_normals);
    EXPECT_NEAR(shared.stats.rms_deg, all.stats.rms_deg, 1e-9);
    EXPECT_EQ(shared.stats.max_deg, all.stats.max_deg);
  }
}

TEST(PaletteHistogramFile, SpacesMustAgree) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  count_maps({{dir / "n.png"}}, {}, std::nullopt, dir / "none");
  count_maps({{dir / "n.png"}}, {}, NormalSpace::kTangent, dir / "tangent");
  count_maps({{dir / "n.png"}}, {}, NormalSpace::kObject, dir / "object");
  EXPECT_FALSE(read_histogram(dir / "none").space);
  EXPECT_EQ(read_histogram(dir / "object").space, NormalSpace::kObject);
  const auto space_of = [&](const std::vector<FileRef>& files, std::optional<NormalSpace> asked) {
    return fit_shared_palette(files, {}, asked).palette.space;
  };
  EXPECT_EQ(space_of({dir / "none"}, {}), NormalSpace::kTangent);
  EXPECT_EQ(space_of({dir / "none", dir / "object"}, {}), NormalSpace::kObject);
  EXPECT_EQ(space_of({dir / "tangent", dir / "object"}, NormalSpace::kObject), NormalSpace::kObject);
  EXPECT_ERROR(space_of({dir / "tangent", dir / "none", dir / "object"}, {}), ErrorKind::kMalformed,
               "object': expected normals in tangent space, as in '" + (dir / "tangent") + "', got object space");
}

TEST(PaletteHistogramFile, MaterialsWantEntriesAndRoom) {
  const ScratchDir dir;
  make_map(dir, "m", "m.png", SampleType::kUint8, 1);
  count_maps({{dir / "m.png", dir / "m_ids.png"}}, {}, std::nullopt, dir / "m.histogram");
  PaletteOptions options;
  options.normals = 3;
  EXPECT_ERROR(fit_shared_palette({dir / "m.histogram"}, options, {}), ErrorKind::kMalformed,
               "at least one for each of the 4 materials in '" + (dir / "m.histogram") + "', got 3");
  EXPECT_ERROR(fit_shared_palette({}, {}, {}), ErrorKind::kUsage, "at least one histogram");
  write_ids(dir / "zeros.png", kW, kH, std::vector<int>(kW * kH));
  EXPECT_ERROR(count_maps({{dir / "m.png", {}, dir / "zeros.png"}}, {}, {}, dir / "x"), ErrorKind::kMalformed,
               "zeros.png': expected texels that are not 0");
  EXPECT_ERROR(read_histogram(dir / "x"), ErrorKind::kIo, "x'");
}

// A file of a body of numbers, or of bytes.
std::string file_of(const std::string& body) {
  std::string out = "burnish-histogram 1\n";
  for (int i = 0; i < 8; i++) out += char(body.size() >> 8 * i);
  uLongf size = compressBound(body.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return out + packed.substr(0, size);
}
std::string body_of(const Numbers& numbers) {
  std::string body;
  for (std::uint64_t n : numbers) {
    for (; n >= 128; n >>= 7) body += char(n | 128);
    body += char(n);
  }
  return body;
}

HistogramFile read(const ScratchDir& dir, const std::string& bytes) {
  write_file(dir / "h", bytes);
  return read_histogram(dir / "h");
}
HistogramFile read_body(const ScratchDir& dir, const Numbers& numbers) { return read(dir, file_of(body_of(numbers))); }

constexpr std::uint64_t kOne = 1, kWords = kOne << 48, kHalves = kOne << 49, kOctahedral = kWords | kHalves,
                        kRebuildsZ = kOne << 52, kMaterial = kOne << 53, kMost = ~std::uint64_t(0);

TEST(PaletteHistogramFileMalformed, Keys) {
  const ScratchDir dir;
  const std::uint64_t up = 128 * (kOne << 32 | 1 << 16) + 255;
  const NormalCounts good = read_body(dir, {1, 0, 2, up, 255 * kMaterial, 3, 4, 0, 5}).counts;
  EXPECT_EQ(good.texels().counted, 7u);
  EXPECT_EQ(histogram_of(good).material, (std::vector<int>{0, 255}));
  EXPECT_EQ(read_body(dir, {0, 0, 1, kOctahedral | ((kOne << 48) - 1), 9, 0}).counts.texels().invalid, 9u);

  const auto refused = [&](const Numbers& numbers, const std::string& message) {
    SCOPED_TRACE(::testing::PrintToString(numbers));
    EXPECT_ERROR(read_body(dir, numbers), ErrorKind::kMalformed, message);
  };
  refused({3, 0, 1, up, 1, 0}, "a space from 0 to 2, got 3");
  refused({0, 2, 1, up, 1, 0}, "a kind of histogram from 0 to 1, got 2");
  refused({0, 0, 0, up, 1, 0}, "a number of keys from 1 to 2097152, got 0");
  refused({0, 0, 1 << 20, up, 1, 0}, "1048576 keys, got the end of the file");
  refused({0, 0, (1 << 21) + 1, up, 1, 0}, "a number of keys from 1 to 2097152, got 2097153");
  refused({0, 0, 2, up, 0, 1, 1, 0, 0}, "a step to the next key from 1 to");
  refused({0, 0, 2, up, kMost, 1, 1, 0, 0}, "a step to the next key");
  refused({0, 0, 1, 256 * kMaterial, 1, 0}, "a key of a normal, got");
  refused({0, 0, 1, kMost, 1, 0}, "a key of a normal, got");
  for (const std::uint64_t key :
       {kOne << 8, kOne << 24, kOne << 40, kHalves | 0x7c00, kHalves | 0x7e01 << 16, kHalves | 0xfc00 * (kOne << 32),
        kRebuildsZ | 1, kRebuildsZ | kWords | 1, kOctahedral | kRebuildsZ, kOctahedral | ((1 << 24) - 1),
        kOctahedral | ((kOne << 24) - 1) << 24})
    refused({0, 0, 1, key, 1, 0}, "a key of a normal, got " + std::to_string(key));
  refused({0, 0, 1, up, 0, 0}, "masked texels of a normal from 1 to");
  refused({0, 0, 1, up, 0, 9}, "texels that are not masked out, got none");
  refused({0, 0, 1, up, (kOne << 48) + 1, 0}, "texels of a normal from 0 to 281474976710656");
  refused({0, 0, 2, up, 1 << 16, kOne << 48, 1, 0, 0}, "texels of a normal from 0 to 0, got 1");
  refused({0, 0, 1, up, kOne << 48, 1}, "masked texels of a normal from 0 to 0, got 1");
  refused({0, 0, 1, up, 1, 0, 0}, "an end, got 1 more bytes");
}

TEST(PaletteHistogramFileMalformed, Bins) {
  const ScratchDir dir;
  // The bin of +z and one of material 3 that is masked out; its texels' sums are what the middle's would be.
  const std::uint64_t up = kOne << 32 | 32767 << 16 | 32767, step = (3 * (kOne << 40) | 99 << 16) - up;
  const NormalCounts good = read_body(dir, {2, 1, 0, 5, 2, up, step, 20, 1, 0, 0, 0, 1, 2, 3}).counts;
  EXPECT_FALSE(good.exact());
  EXPECT_EQ(good.texels().counted, 20u);
  EXPECT_EQ(good.texels().invalid, 5u);
  const Histogram h = histogram_of(good);
  EXPECT_EQ(h.material, (std::vector<int>{0, 3}));
  EXPECT_EQ(h.groups[0][0].normal, (Vec3f{0, 0, 1}));
  EXPECT_EQ(h.groups[0][0].weight, 20);

  const auto refused = [&](const Numbers& numbers, const std::string& message) {
    SCOPED_TRACE(::testing::PrintToString(numbers));
    EXPECT_ERROR(read_body(dir, numbers), ErrorKind::kMalformed, message);
  };
  refused({2, 1, 17, 0, 1, up, 1, 0, 0, 0}, "bits that bins are coarser by from 0 to 16, got 17");
  refused({2, 1, 0, 21, 1, up, 20, 0, 0, 0}, "at most 20 invalid texels, got 21");
  refused({2, 1, 0, 0, 3, up, 1, 0, 0, 0}, "3 bins, got the end of the file");
  refused({2, 1, 0, 0, (1 << 20) + 1, up, 1, 0, 0, 0}, "a number of bins from 1 to 1048576, got 1048577");
  refused({2, 1, 0, 0, 1, up, 0, 0, 0, 0}, "texels of a bin from 1 to");
  refused({2, 1, 0, 0, 1, up, (kOne << 35) + 1, 0, 0, 0}, "texels of a bin from 1 to 34359738368");
  refused({2, 1, 0, 0, 2, up, 0, 1, 1, 0, 0, 0, 0, 0, 0}, "a step to the next key");
  refused({2, 1, 0, 0, 1, up | kOne << 33, 1, 0, 0, 0}, "a key of a normal");
  refused({2, 1, 0, 0, 1, up | kOne << 48, 1, 0, 0, 0}, "a key of a normal");
  refused({2, 1, 0, 0, 1, up | 0xffff, 1, 0, 0, 0}, "a key of a normal");
  refused({2, 1, 1, 0, 1, up, 1, 0, 0, 0}, "a key of a normal");
  refused({2, 1, 0, 0, 1, up & 0xffffffff, 1, 0, 0, 0}, "texels that are not masked out");
  // A component that is half a unit from where that bin's normals have it.
  for (int c = 0; c < 3; c++) {
    Numbers numbers{2, 1, 0, 0, 1, up, 1, 0, 0, 0};
    numbers[7 + c] = 1 << 26;
    refused(numbers, "a sum of unit normals from 0 to");
  }
}

TEST(PaletteHistogramFileMalformed, WhatIsAroundTheNumbers) {
  const ScratchDir dir;
  const std::string body = body_of({0, 0, 1, 77, 1, 0}), good = file_of(body);
  EXPECT_EQ(read(dir, good).counts.texels().counted, 1u);
  const auto refused = [&](const std::string& bytes, const std::string& message,
                           ErrorKind kind = ErrorKind::kMalformed) {
    SCOPED_TRACE(::testing::PrintToString(bytes));
    EXPECT_ERROR(read(dir, bytes), kind, message);
    EXPECT_ERROR(read(dir, bytes), kind, "h'");
  };
  for (std::size_t n = 0; n < good.size(); n++) refused(good.substr(0, n), "expected");
  refused(good + '\0', "an end, got 1 more bytes");
  refused(good + good, "more bytes");
  refused("", "a histogram, as --histogram-output writes it");
  refused("burnish-histogram 2\n" + good.substr(20), "burnish-histogram 1", ErrorKind::kUnsupported);
  refused("burnish-histogram 10\n" + good.substr(20), "burnish-histogram 1", ErrorKind::kUnsupported);
  refused("burnish-histogran 1\n" + good.substr(20), "a histogram, as");
  const auto with_size = [&](std::uint64_t size) {
    std::string bytes = good;
    for (int i = 0; i < 8; i++) bytes[20 + i] = char(size >> 8 * i);
    return bytes;
  };
  refused(with_size(body.size() - 1), "a zlib stream of 5 bytes");
  refused(with_size(body.size() + 1), "a zlib stream of 7 bytes");
  refused(with_size(0), "a zlib stream of 0 bytes");
  refused(with_size(1 << 20), "expected at most");  // before there is memory for it
  refused(with_size(kMost), "expected at most");
  refused(file_of(body + '\0'), "an end, got 1 more bytes");
  using std::string_literals::operator""s;
  for (const std::string& number :
       {"\x80\0"s, "\x81\x80\0"s, std::string(9, '\xff') + '\2', std::string(10, '\xff') + '\1'})
    refused(file_of(body_of({0, 0, 1}) + number + body_of({1, 0})), "shortest form");
}

// Whatever a changed byte says: an error of ours, or counts that are written and read back.
TEST(PaletteHistogramFileMalformed, DamagedOnesAreRefusedOrSound) {
  const ScratchDir dir;
  const MapFiles map = make_map(dir, "m", "m.png", SampleType::kUint8, 2, false, 9, 7);
  count_maps({map}, {}, NormalSpace::kTangent, dir / "exact");
  std::mt19937 random(1);
  int read_well = 0;
  const auto expect_sound = [&](const std::string& bytes) {
    write_file(dir / "d", bytes);
    try {
      const HistogramFile file = read_histogram(dir / "d");
      write_histogram(dir / "e", file);
      expect_same(file.counts, read_histogram(dir / "e").counts);
      read_well++;
    } catch (const Error& e) {
      EXPECT_TRUE(e.kind() == ErrorKind::kMalformed || e.kind() == ErrorKind::kUnsupported) << e.what();
    }
  };
  Numbers bins{1, 1, 0, 0, 40};
  for (int i = 0; i < 40; i++) bins.push_back(i ? 65537 * 700 : kOne << 32 | 32767 << 16 | 99);
  for (int i = 0; i < 40; i++) bins.push_back(1 + i * i);
  for (int i = 0; i < 120; i++) bins.push_back(i * 3);
  const std::string exact = read_file(dir / "exact");
  std::string body(exact.size() * 100, '\0');
  uLongf size = body.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(body.data()), &size, reinterpret_cast<const Bytef*>(exact.data() + 28),
                       exact.size() - 28),
            Z_OK);
  body.resize(size);
  for (int i = 0; i < 500; i++) {
    expect_sound(damaged(exact, 28, std::string("\0\1\xff", 3), i, random));
    expect_sound(file_of(damaged(body, 40, std::string("\0\1\x7f\x80\xff", 5), i, random)));
    expect_sound(file_of(damaged(body_of(bins), 60, std::string("\0\1\x7f\x80\xff", 5), i, random)));
  }
  EXPECT_GT(read_well, 30);
}

}  // namespace
}  // namespace burnish
