// One palette for many maps.
#include <gtest/gtest.h>

#include "burnish/core/parallel.h"
#include "burnish/palette/quantize.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;

constexpr int kW = 80, kH = 60;

struct Shared {
  QuantizeResult result;
  std::vector<IndexedMap> maps;
};

Shared quantize(std::vector<MapFiles> files, const QuantizeOptions& options) {
  Shared out;
  out.maps.resize(files.size());
  std::size_t next = 0;
  out.result =
      quantize_normal_maps(std::move(files), options, [&](std::size_t i, const Palette& palette, int width, int) {
        EXPECT_EQ(i, next++);
        out.maps[i].palette = palette;
        return append_to(out.maps[i].levels.emplace_back(), width);
      });
  return out;
}

// Three maps that differ, with materials and masks, and the three one above the other in one file.
struct Stack {
  ScratchDir dir;
  std::vector<MapFiles> apart;
  MapFiles together;
  std::vector<std::vector<Vec3f>> normals;
  std::vector<std::vector<int>> masks;

  Stack() {
    std::vector<Vec3f> all;
    std::vector<int> all_ids, all_mask;
    for (int m = 0; m < 3; m++) {
      Random random(10 + std::uint32_t(m));
      std::vector<Vec3f> n = bumpy_normals(kW, kH, 1 + std::uint32_t(m));
      std::vector<int> ids, mask;
      for (Vec3f& v : n) {
        if (m == 1) v = Vec3f{v.y, v.z, v.x};
        ids.push_back(m == 2 ? 9 : random.below(3));
        mask.push_back(random.below(4) ? 1 : 0);
      }
      const std::string name = std::to_string(m);
      write_normals(dir / ("n" + name + ".png"), SampleType::kUint8, kW, kH, n);
      write_ids(dir / ("ids" + name + ".png"), kW, kH, ids);
      write_ids(dir / ("mask" + name + ".png"), kW, kH, mask);
      apart.push_back({dir / ("n" + name + ".png"), dir / ("ids" + name + ".png"), dir / ("mask" + name + ".png")});
      int w, h;
      normals.push_back(read_normals(apart.back().normals, {}, &w, &h));
      masks.push_back(mask);
      all.insert(all.end(), n.begin(), n.end());
      all_ids.insert(all_ids.end(), ids.begin(), ids.end());
      all_mask.insert(all_mask.end(), mask.begin(), mask.end());
    }
    write_normals(dir / "n.png", SampleType::kUint8, kW, 3 * kH, all);
    write_ids(dir / "ids.png", kW, 3 * kH, all_ids);
    write_ids(dir / "mask.png", kW, 3 * kH, all_mask);
    together = {dir / "n.png", dir / "ids.png", dir / "mask.png"};
  }
};

TEST(PaletteShared, MapsApartAreAsOneMapOfThemAll) {
  const Stack stack;
  for (const Engine engine : {Engine::kSpherical, Engine::kMedianCut})
    for (const MaterialEncoding encoding :
         {MaterialEncoding::kSplit, MaterialEncoding::kAlpha, MaterialEncoding::kSubcubes}) {
      QuantizeOptions options;
      options.normals = 120;
      options.engine = engine;
      options.encoding = encoding;
      const Shared apart = quantize(stack.apart, options);
      const QuantizedMap together = quantize_normal_map(stack.together, options);
      EXPECT_EQ(apart.result.palette.normals, together.map.palette.normals);
      EXPECT_EQ(apart.result.palette.materials, together.map.palette.materials);
      std::vector<std::uint16_t> indices;
      for (const IndexedMap& map : apart.maps) {
        EXPECT_EQ(map.palette.normals, together.map.palette.normals);
        EXPECT_EQ(map.levels.size(), 1u);
        indices.insert(indices.end(), map.levels[0].data.begin(), map.levels[0].data.end());
      }
      EXPECT_EQ(indices, together.map.levels[0].data);
      const QuantizeStats &a = apart.result.stats, &t = together.stats;
      EXPECT_EQ(a.texels, t.texels);
      EXPECT_EQ(a.normals, t.normals);
      EXPECT_EQ(a.distinct_input_normals, t.distinct_input_normals);
      EXPECT_NEAR(a.rms_deg, t.rms_deg, 1e-9);
      EXPECT_NEAR(a.mean_deg, t.mean_deg, 1e-9);
      EXPECT_EQ(a.p95_deg, t.p95_deg);
      EXPECT_EQ(a.max_deg, t.max_deg);
    }
}

TEST(PaletteShared, EachMapsFiguresAreItsOwn) {
  const Stack stack;
  for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
    QuantizeOptions options;
    options.normals = 120;
    options.dither = dither;
    const Shared shared = quantize(stack.apart, options);
    ASSERT_EQ(shared.result.maps.size(), 3u);
    for (int m = 0; m < 3; m++) {
      double squares = 0, most = 0;
      std::size_t texels = 0;
      for (std::size_t i = 0; i < stack.normals[m].size(); i++)
        if (stack.masks[m][i]) {
          const double a =
              angle_deg(stack.normals[m][i], shared.maps[m].palette.normals[shared.maps[m].levels[0].data[i]]);
          squares += a * a, most = std::max(most, a), texels++;
        }
      const MapStats& s = shared.result.maps[m];
      EXPECT_EQ(s.texels, texels);
      EXPECT_NEAR(s.rms_deg, std::sqrt(squares / double(texels)), 1e-5) << "map " << m << " dither " << int(dither);
      EXPECT_NEAR(s.max_deg, most, 1e-4);
      EXPECT_EQ(s.invalid_texels, 0u);
    }
  }
}

TEST(PaletteShared, TheOrderOfTheMapsIsOfNoConcern) {
  const Stack stack;
  QuantizeOptions options;
  options.normals = 100;
  const Shared one = quantize({stack.apart[0], stack.apart[1], stack.apart[2]}, options);
  const Shared two = quantize({stack.apart[2], stack.apart[0], stack.apart[1]}, options);
  EXPECT_EQ(one.result.palette.normals, two.result.palette.normals);
  EXPECT_EQ(one.maps[0].levels[0].data, two.maps[1].levels[0].data);
  EXPECT_EQ(one.maps[2].levels[0].data, two.maps[0].levels[0].data);
}

TEST(PaletteShared, SizesAndSamplesMayDiffer) {
  const ScratchDir dir;
  Random random(3);
  const std::vector<Vec3f> few = random.directions(40);
  std::vector<MapFiles> files;
  std::vector<std::vector<Vec3f>> normals;
  struct Stored {
    const char* file;
    SampleType sample;
    int width, height;
  };
  for (const Stored& s : {Stored{"a.png", SampleType::kUint8, 50, 20}, Stored{"b.png", SampleType::kUint16, 1, 700},
                          Stored{"c.exr", SampleType::kHalf, 90, 3}, Stored{"d.exr", SampleType::kFloat, 64, 64}}) {
    std::vector<Vec3f>& n = normals.emplace_back();
    for (int i = 0; i < s.width * s.height; i++) n.push_back(few[i < 40 ? i : random.below(40)]);
    write_normals(dir / s.file, s.sample, s.width, s.height, n);
    files.push_back({dir / s.file});
  }
  QuantizeOptions options;
  options.normals = 40;
  const Shared shared = quantize(files, options);
  ASSERT_EQ(shared.maps.size(), 4u);
  // The same 40 directions stored in four ways, 0.4 degrees apart at most.
  EXPECT_GT(shared.result.stats.distinct_input_normals, 40u);
  EXPECT_LT(shared.result.stats.max_deg, 0.4);
  for (std::size_t m = 0; m < 4; m++)
    for (std::size_t i = 0; i < normals[m].size(); i++)
      ASSERT_LT(angle_deg(normals[m][i], shared.maps[m].palette.normals[shared.maps[m].levels[0].data[i]]), 0.8)
          << "map " << m << " texel " << i;
  options.normals = 1000;
  EXPECT_TRUE(quantize(files, options).result.stats.lossless);
}

TEST(PaletteShared, MaterialsThatOnlySomeMapsHave) {
  const Stack stack;  // 0, 1, 2 in the first two maps, 9 in the third
  QuantizeOptions options;
  options.normals = 60;
  const Shared shared = quantize(stack.apart, options);
  ASSERT_EQ(shared.result.palette.materials.size(), 4u);
  EXPECT_EQ(shared.result.palette.materials[3].id, 9);
  for (const std::uint16_t i : shared.maps[2].levels[0].data) ASSERT_EQ(shared.result.palette.interval_of(i), 3);
  for (const std::uint16_t i : shared.maps[0].levels[0].data) ASSERT_LT(shared.result.palette.interval_of(i), 3);
}

TEST(PaletteShared, TooManyNormalsInAllAreCountedInBins) {
  const ScratchDir dir;
  Random random(4);
  std::vector<MapFiles> files;
  std::vector<Vec3f> all;
  const int w = 1024, h = 1100;  // 1.1 million each, of at most 2.1 million
  for (const char* file : {"a.exr", "b.exr"}) {
    const std::vector<Vec3f> normals = random.directions(std::size_t(w) * h);
    write_normals(dir / file, SampleType::kFloat, w, h, normals);
    all.insert(all.end(), normals.begin(), normals.end());
    files.push_back({dir / file});
  }
  write_normals(dir / "ab.exr", SampleType::kFloat, w, 2 * h, all);
  QuantizeOptions options;
  options.normals = 100;
  EXPECT_GT(quantize({files[0]}, options).result.stats.distinct_input_normals, 1100000u);  // one alone is kept as it is
  const Shared shared = quantize(files, options);
  const QuantizedMap one = quantize_normal_map({dir / "ab.exr"}, options);
  EXPECT_LT(shared.result.stats.distinct_input_normals, std::size_t(1) << 20);
  EXPECT_EQ(shared.result.stats.distinct_input_normals, one.stats.distinct_input_normals);
  EXPECT_EQ(shared.result.palette.normals, one.map.palette.normals);
  EXPECT_EQ(shared.result.stats.texels, all.size());
  EXPECT_NEAR(shared.result.stats.rms_deg, one.stats.rms_deg, 1e-9);
}

TEST(PaletteShared, TheSameForAnyNumberOfThreads) {
  const Stack stack;
  Shared shared[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    shared[threads - 1] = quantize(stack.apart, {});
  }
  EXPECT_EQ(shared[0].result.palette.normals, shared[1].result.palette.normals);
  EXPECT_EQ(shared[0].result.stats.rms_deg, shared[1].result.stats.rms_deg);
  for (int m = 0; m < 3; m++) EXPECT_EQ(shared[0].maps[m].levels[0].data, shared[1].maps[m].levels[0].data);
}

TEST(PaletteShared, AnErrorNamesItsMap) {
  const Stack stack;
  std::vector<MapFiles> files = stack.apart;
  files[1].mask = stack.together.mask;
  EXPECT_ERROR(quantize(files, {}), ErrorKind::kMalformed, "mask.png'");
  files = stack.apart;
  files[2].normals = stack.dir / "none.png";
  EXPECT_ERROR(quantize(files, {}), ErrorKind::kIo, "none.png'");
  EXPECT_ERROR(quantize({}, {}), ErrorKind::kUsage, "at least one map");
}

}  // namespace
}  // namespace burnish
