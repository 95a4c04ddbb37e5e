#include <gtest/gtest.h>

#include <set>

#include "burnish/core/parallel.h"
#include "burnish/palette/fit/imagequant_engine.h"
#include "burnish/palette/quantize.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;

constexpr int kW = 96, kH = 64;

Vec3f normal_at(const IndexedMap& map, std::size_t i) { return map.palette.normals[map.levels[0].data[i]]; }

// RMS angle between a map and what was stored, over the texels that count.
double rms_deg(const std::vector<Vec3f>& normals, const IndexedMap& map, const std::vector<int>& mask = {}) {
  double squares = 0;
  int texels = 0;
  for (std::size_t i = 0; i < normals.size(); i++)
    if (mask.empty() || mask[i]) squares += std::pow(angle_deg(normals[i], normal_at(map, i)), 2), texels++;
  return std::sqrt(squares / texels);
}

std::vector<Vec3f> stored(const std::string& file) {
  int w, h;
  return read_normals(file, {}, &w, &h);
}

void expect_well_formed(const IndexedMap& map) {
  int next = 0, last_id = -1;
  for (const MaterialInterval& m : map.palette.materials) {
    EXPECT_EQ(m.first, next);
    EXPECT_GE(m.count, 1);
    EXPECT_GT(m.id, last_id);
    next += m.count, last_id = m.id;
  }
  EXPECT_EQ(next, int(map.palette.normals.size()));
  for (const Vec3f& n : map.palette.normals) EXPECT_NEAR(length(Vec3d(n)), 1, 1e-5);
  for (const std::uint16_t i : map.levels[0].data) EXPECT_LT(i, next);
}

// Four blobs, ids 5, 0, 255 and 17, the last of a few texels only.
std::vector<int> blobs() {
  std::vector<int> ids;
  for (int y = 0; y < kH; y++)
    for (int x = 0; x < kW; x++)
      ids.push_back(x < 3 && y < 2 ? 17 : (x / 13 + y / 9) % 3 == 0 ? 5 : x + y < 70 ? 0 : 255);
  return ids;
}

TEST(PaletteQuantize, LosslessWhereThePaletteHoldsEveryNormal) {
  const ScratchDir dir;
  Random random(1);
  const std::vector<Vec3f> few = random.directions(200);
  std::vector<Vec3f> normals;
  for (int i = 0; i < kW * kH; i++) normals.push_back(few[i < 200 ? i : random.below(200)]);
  struct Case {
    const char* file;
    SampleType sample;
  };
  for (const Case& c :
       {Case{"n.png", SampleType::kUint8}, Case{"n.png", SampleType::kUint16}, Case{"n.tif", SampleType::kUint16},
        Case{"n.exr", SampleType::kHalf}, Case{"n.exr", SampleType::kFloat}})
    for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
      write_normals(dir / c.file, c.sample, kW, kH, normals);
      QuantizeOptions options;
      options.normals = 200;
      options.dither = dither;
      const QuantizedMap r = quantize_normal_map({dir / c.file}, options);
      const std::vector<Vec3f> in = stored(dir / c.file);
      expect_well_formed(r.map);
      EXPECT_LE(r.stats.distinct_input_normals, 200u);
      EXPECT_EQ(r.stats.normals, int(r.stats.distinct_input_normals));
      EXPECT_TRUE(r.stats.lossless) << c.file << " " << name(c.sample);
      EXPECT_EQ(r.stats.max_deg, 0) << c.file << " " << name(c.sample);
      for (std::size_t i = 0; i < in.size(); i++) {
        ASSERT_LT(angle_deg(in[i], normal_at(r.map, i)), 3e-5) << c.file << " " << name(c.sample) << " texel " << i;
      }
    }
}

// One step of 16 bits apart, less than the rounding of a dot product tells apart.
TEST(PaletteQuantize, LosslessForNormalsOneStepApart) {
  const ScratchDir dir;
  Image image(500, 2, 3);
  for (int i = 0; i < 1000; i++)
    for (int c = 0; c < 3; c++) image.data[3 * i + c] = float(c == 0 ? 32768 + i : c == 1 ? 32768 : 65535) / 65535.f;
  write_image(dir / "n.png", FileType::kPng, SampleType::kUint16, image);
  for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
    QuantizeOptions options;
    options.normals = 1000;
    options.dither = dither;
    const QuantizedMap r = quantize_normal_map({dir / "n.png"}, options);
    EXPECT_TRUE(r.stats.lossless) << "dither " << int(dither);
    EXPECT_GT(r.stats.normals, 990);
    const std::vector<Vec3f> in = stored(dir / "n.png");
    for (std::size_t i = 0; i < in.size(); i++) ASSERT_LT(angle_deg(in[i], normal_at(r.map, i)), 3e-5) << "texel " << i;
  }
}

TEST(PaletteQuantize, ReportsWhatBruteForceMeasures) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  write_normals(dir / "n.exr", SampleType::kFloat, kW, kH, bumpy_normals(kW, kH));
  for (const char* file : {"n.png", "n.exr"})
    for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
      QuantizeOptions options;
      options.normals = 64;
      options.dither = dither;
      const QuantizedMap r = quantize_normal_map({dir / file}, options);
      expect_well_formed(r.map);
      const std::vector<Vec3f> in = stored(dir / file);
      EXPECT_EQ(r.stats.normals, 64);
      EXPECT_EQ(r.stats.texels, in.size());
      EXPECT_FALSE(r.stats.lossless);
      EXPECT_NEAR(r.stats.rms_deg, rms_deg(in, r.map), 1e-5);
      std::vector<double> angles;
      double sum = 0;
      for (std::size_t i = 0; i < in.size(); i++) {
        angles.push_back(angle_deg(in[i], normal_at(r.map, i)));
        sum += angles.back();
        if (dither != Dither::kNone) continue;
        const Vec3f nearest = r.map.palette.normals[testing::brute_nearest(r.map.palette.normals, in[i])];
        ASSERT_NEAR(angles.back(), angle_deg(in[i], nearest), 1e-3);
      }
      std::ranges::sort(angles);
      EXPECT_NEAR(r.stats.mean_deg, sum / double(in.size()), 1e-5);
      EXPECT_NEAR(r.stats.max_deg, angles.back(), 1e-4);
      EXPECT_NEAR(r.stats.p95_deg, angles[angles.size() * 95 / 100], 0.03 * r.stats.p95_deg);
    }
}

TEST(PaletteQuantize, NoTexelChangesItsMaterial) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  const std::vector<int> ids = blobs();
  write_ids(dir / "ids.png", kW, kH, ids);
  for (const Engine engine : {Engine::kSpherical, Engine::kMedianCut, Engine::kImagequant})
    for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
      if (engine == Engine::kImagequant && !has_imagequant()) continue;
      QuantizeOptions options;
      options.normals = 40;
      options.engine = engine;
      options.dither = dither;
      const QuantizedMap r = quantize_normal_map({dir / "n.png", dir / "ids.png"}, options);
      expect_well_formed(r.map);
      EXPECT_LE(r.stats.normals, 40);
      ASSERT_EQ(r.map.palette.materials.size(), 4u);
      for (std::size_t i = 0; i < ids.size(); i++)
        ASSERT_EQ(r.map.palette.materials[r.map.palette.interval_of(r.map.levels[0].data[i])].id, ids[i])
            << "engine " << int(engine) << " dither " << int(dither) << " texel " << i;
      EXPECT_NEAR(r.stats.rms_deg, rms_deg(stored(dir / "n.png"), r.map), 1e-5);
    }
  QuantizeOptions options;
  options.normals = 3;
  EXPECT_ERROR(quantize_normal_map({dir / "n.png", dir / "ids.png"}, options), ErrorKind::kMalformed, "4 materials");
}

TEST(PaletteQuantize, WhatIsMaskedShapesNothingAndCountsNothing) {
  const ScratchDir dir;
  std::vector<Vec3f> normals = bumpy_normals(kW, kH);
  std::vector<int> mask;
  Random random(2);
  for (Vec3f& n : normals) {
    mask.push_back(random.below(3) ? 255 : 0);
    if (!mask.back()) n = random.direction();
  }
  write_normals(dir / "n.exr", SampleType::kFloat, kW, kH, normals);
  write_ids(dir / "mask.png", kW, kH, mask);
  for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
    QuantizeOptions options;
    options.normals = 64;
    options.dither = dither;
    const QuantizedMap r = quantize_normal_map({dir / "n.exr", {}, dir / "mask.png"}, options);
    EXPECT_EQ(r.stats.texels, std::size_t(std::ranges::count(mask, 255)));
    EXPECT_NEAR(r.stats.rms_deg, rms_deg(stored(dir / "n.exr"), r.map, mask), 1e-4);
    for (const Vec3f& n : r.map.palette.normals) EXPECT_GT(n.z, 0.3);
    if (dither != Dither::kNone) continue;
    // What is masked takes the nearest entry all the same, however far that is.
    const std::vector<Vec3f> in = stored(dir / "n.exr");
    for (std::size_t i = 0; i < in.size(); i++) {
      const Vec3f nearest = r.map.palette.normals[testing::brute_nearest(r.map.palette.normals, in[i])];
      ASSERT_NEAR(angle_deg(in[i], normal_at(r.map, i)), angle_deg(in[i], nearest), 1e-3) << "texel " << i;
    }
  }
}

TEST(PaletteQuantize, AMaterialMaskedOutWholeHasOneEntryAndCountsNothing) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  const std::vector<int> ids = blobs();
  write_ids(dir / "ids.png", kW, kH, ids);
  std::vector<int> mask;
  for (const int id : ids) mask.push_back(id == 0 ? 0 : 255);
  write_ids(dir / "mask.png", kW, kH, mask);
  for (const Dither dither : {Dither::kNone, Dither::kDiffusion}) {
    QuantizeOptions options;
    options.normals = 30;
    options.dither = dither;
    const QuantizedMap r = quantize_normal_map({dir / "n.png", dir / "ids.png", dir / "mask.png"}, options);
    expect_well_formed(r.map);
    ASSERT_EQ(r.map.palette.materials.size(), 4u);
    EXPECT_EQ(r.map.palette.materials[0].count, 1) << "entries for what is not used";
    EXPECT_EQ(r.stats.normals, 30);
    EXPECT_EQ(r.stats.texels, std::size_t(std::ranges::count(mask, 255)));
    EXPECT_NEAR(r.stats.rms_deg, rms_deg(stored(dir / "n.png"), r.map, mask), 1e-5) << "dither " << int(dither);
  }
}

TEST(PaletteQuantize, TheSmallestPaletteThatMeetsATarget) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  for (const Engine engine : {Engine::kSpherical, Engine::kMedianCut})
    for (const double target : {12.0, 4.0, 1.5}) {
      QuantizeOptions options;
      options.engine = engine;
      options.target_error_deg = target;
      const QuantizedMap r = quantize_normal_map({dir / "n.png"}, options);
      EXPECT_LE(r.stats.rms_deg, target);
      options.target_error_deg.reset();
      options.normals = r.stats.normals;
      EXPECT_EQ(quantize_normal_map({dir / "n.png"}, options).map.palette.normals, r.map.palette.normals);
      options.normals = r.stats.normals - 1;
      ASSERT_GE(options.normals, 2);
      EXPECT_GT(quantize_normal_map({dir / "n.png"}, options).stats.rms_deg, target)
          << "with one less than " << r.stats.normals;
    }
  QuantizeOptions options;
  options.target_error_deg = 0;
  const QuantizedMap exact = quantize_normal_map({dir / "n.png"}, options);
  EXPECT_TRUE(exact.stats.lossless);
  EXPECT_EQ(exact.stats.normals, int(exact.stats.distinct_input_normals));
  if (has_imagequant()) {
    options.target_error_deg = 0.01;
    options.engine = Engine::kImagequant;
    EXPECT_ERROR(quantize_normal_map({dir / "n.png"}, options), ErrorKind::kThreshold, "256 normals");
  }
}

TEST(PaletteQuantize, AGivenPaletteIsUsedAsItIs) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  write_ids(dir / "ids.png", kW, kH, blobs());
  Palette palette = testing::random_map(1, 1, 90, 1).palette;
  palette.materials = {
      {255, 0, 20}, {17, 20, 1}, {3, 21, 30}, {0, 51, 19}, {5, 70, 20}};  // in any order, with one to spare
  palette.space = NormalSpace::kObject;
  for (const char* file : {"p.exr", "p.png"}) {
    write_palette(dir / file, file_type_of(file), palette);
    QuantizeOptions options;
    options.palette = dir / file;
    const QuantizedMap r = quantize_normal_map({dir / "n.png", dir / "ids.png"}, options);
    EXPECT_EQ(r.map.palette.normals, palette.normals);
    EXPECT_EQ(r.map.palette.materials, palette.materials);
    EXPECT_EQ(r.stats.normals, 90);
    const std::vector<Vec3f> in = stored(dir / "n.png");
    const std::vector<int> ids = blobs();
    for (std::size_t i = 0; i < in.size(); i++) {
      const auto m = std::ranges::find(palette.materials, ids[i], &MaterialInterval::id);
      ASSERT_EQ(r.map.levels[0].data[i],
                m->first + testing::brute_nearest(std::span(palette.normals).subspan(m->first, m->count), in[i]));
    }
  }
  palette.materials = {{255, 0, 20}, {17, 20, 1}, {0, 21, 69}};
  write_palette(dir / "p.exr", FileType::kExr, palette);
  QuantizeOptions options;
  options.palette = dir / "p.exr";
  EXPECT_ERROR(quantize_normal_map({dir / "n.png", dir / "ids.png"}, options), ErrorKind::kMalformed,
               "'" + (dir / "p.exr") + "': expected entries for material 5");
}

TEST(PaletteQuantize, EnginesToCompareWith) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
  double spherical = 0;
  for (const Engine engine : {Engine::kSpherical, Engine::kMedianCut, Engine::kImagequant}) {
    if (engine == Engine::kImagequant && !has_imagequant()) continue;
    QuantizeOptions options;
    options.engine = engine;
    options.normals = 64;
    const QuantizedMap r = quantize_normal_map({dir / "n.png"}, options);
    expect_well_formed(r.map);
    EXPECT_LE(r.stats.normals, 64);
    EXPECT_GE(r.stats.normals, 60);
    EXPECT_LT(r.stats.rms_deg, 10);
    if (engine == Engine::kSpherical) spherical = r.stats.rms_deg;
    EXPECT_LE(spherical, r.stats.rms_deg) << int(engine);
  }
  QuantizeOptions options;
  options.engine = Engine::kImagequant;
  options.normals = 257;
  EXPECT_ERROR(quantize_normal_map({dir / "n.png"}, options), ErrorKind::kUnsupported, "imagequant");
}

TEST(PaletteQuantize, OptionsOutOfRange) {
  const ScratchDir dir;
  write_normals(dir / "n.png", SampleType::kUint8, 4, 4, bumpy_normals(4, 4));
  for (const int n : {-1, 0, 1, 65537}) {
    QuantizeOptions options;
    options.normals = n;
    EXPECT_ERROR(quantize_normal_map({dir / "n.png"}, options), ErrorKind::kUsage, "2 to 65536");
  }
  for (const double amount : {-0.1, 1.1, std::nan("")}) {
    QuantizeOptions options;
    options.dither_amount = amount;
    EXPECT_ERROR(quantize_normal_map({dir / "n.png"}, options), ErrorKind::kUsage,
                 "dither-amount: expected 0 to 1, got ");
  }
  for (const double target : {-1.0, 181.0, std::nan("")}) {
    QuantizeOptions options;
    options.target_error_deg = target;
    EXPECT_ERROR(quantize_normal_map({dir / "n.png"}, options), ErrorKind::kUsage,
                 "target-error: expected degrees from 0 to 180, got ");
  }
}

TEST(PaletteQuantize, InvalidAndBrokenVectors) {
  const ScratchDir dir;
  Image image(4, 3, 3);
  for (int i = 0; i < 12; i++) image.data[3 * i + 2] = i < 5 ? 0.f : 1.f;
  write_image(dir / "n.exr", FileType::kExr, SampleType::kHalf, image);
  const QuantizedMap r = quantize_normal_map({dir / "n.exr"}, {});
  EXPECT_EQ(r.stats.invalid_texels, 5u);
  EXPECT_EQ(r.stats.normals, 1);
  EXPECT_EQ(normal_at(r.map, 0), (Vec3f{0, 0, 1}));
  for (const SampleType sample : {SampleType::kHalf, SampleType::kFloat})
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
      Image broken = image;
      broken.data[3 * 6 + 1] = bad;
      write_image(dir / "b.exr", FileType::kExr, sample, broken);
      EXPECT_ERROR(quantize_normal_map({dir / "b.exr"}, {}), ErrorKind::kMalformed, "column 2, row 1");
    }
}

TEST(PaletteQuantize, GreenDownIsTheSameMapFlipped) {
  const ScratchDir dir;
  const std::vector<Vec3f> normals = bumpy_normals(kW, kH);
  write_normals(dir / "up.exr", SampleType::kFloat, kW, kH, normals);
  write_normals(dir / "down.exr", SampleType::kFloat, kW, kH, normals, true);
  QuantizeOptions options;
  options.normals = 50;
  const QuantizedMap up = quantize_normal_map({dir / "up.exr"}, options);
  options.coding.green = GreenAxis::kDown;
  const QuantizedMap down = quantize_normal_map({dir / "down.exr"}, options);
  EXPECT_EQ(up.map.palette.normals, down.map.palette.normals);
  EXPECT_EQ(up.map.levels[0].data, down.map.levels[0].data);
}

TEST(PaletteQuantize, DitheringKeepsTheMeansOfBlocks) {
  const ScratchDir dir;
  const int side = 128;
  std::vector<Vec3f> normals;
  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++)
      normals.push_back(Vec3f(normalized(Vec3d{std::sin(0.01 * x), std::cos(0.013 * y), 1.2})));
  write_normals(dir / "n.tif", SampleType::kUint16, side, side, normals);
  double plain = 0;
  for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
    QuantizeOptions options;
    options.normals = 48;
    options.dither = dither;
    const QuantizedMap r = quantize_normal_map({dir / "n.tif"}, options);
    double squares = 0;
    for (int by = 0; by < side; by += 4)
      for (int bx = 0; bx < side; bx += 4) {
        Vec3d wanted, got;
        for (int y = by; y < by + 4; y++)
          for (int x = bx; x < bx + 4; x++)
            wanted += Vec3d(normals[y * side + x]), got += Vec3d(normal_at(r.map, y * side + x));
        squares += std::pow(degrees(angle_rad(wanted, got)), 2);
      }
    if (dither == Dither::kNone) plain = std::sqrt(squares);
    else EXPECT_LT(std::sqrt(squares), 0.65 * plain) << int(dither);
    options.dither_amount = 0;
    options.dither = dither;
    const QuantizedMap none = quantize_normal_map({dir / "n.tif"}, options);
    options.dither = Dither::kNone;
    EXPECT_EQ(none.map.levels[0].data, quantize_normal_map({dir / "n.tif"}, options).map.levels[0].data);
  }
}

TEST(PaletteQuantize, TheSameForAnyNumberOfThreads) {
  const ScratchDir dir;
  const int width = 150, height = 1100;  // more than two bands
  write_normals(dir / "n.png", SampleType::kUint8, width, height, bumpy_normals(width, height));
  write_normals(dir / "n.exr", SampleType::kFloat, width, height, bumpy_normals(width, height));
  for (const char* file : {"n.png", "n.exr"})
    for (const Dither dither : {Dither::kNone, Dither::kDiffusion, Dither::kBlueNoise}) {
      QuantizedMap r[2];
      for (int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        QuantizeOptions options;
        options.normals = 100;
        options.dither = dither;
        r[threads - 1] = quantize_normal_map({dir / file}, options);
      }
      EXPECT_EQ(r[0].map.palette.normals, r[1].map.palette.normals) << file;
      EXPECT_EQ(r[0].map.levels[0].data, r[1].map.levels[0].data) << file << " dither " << int(dither);
      EXPECT_EQ(r[0].stats.rms_deg, r[1].stats.rms_deg) << file;
      EXPECT_EQ(r[0].stats.p95_deg, r[1].stats.p95_deg) << file;
    }
}

}  // namespace
}  // namespace burnish
