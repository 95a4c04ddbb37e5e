// Materials and normals quantized together, in the cube of their colours.
#include <gtest/gtest.h>

#include "burnish/palette/files/cube_image.h"
#include "burnish/palette/fit/imagequant_engine.h"
#include "burnish/palette/quantize.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;

constexpr int kW = 96, kH = 64;
constexpr MaterialEncoding kEncodings[] = {MaterialEncoding::kAlpha, MaterialEncoding::kSubcubes};

std::vector<Engine> engines() {
  std::vector<Engine> out{Engine::kSpherical, Engine::kMedianCut};
  if (has_imagequant()) out.push_back(Engine::kImagequant);
  return out;
}

// Ids 3, 40, 41 and 250; the last of two texels only.
std::vector<int> ids() {
  std::vector<int> out;
  for (int i = 0; i < kW * kH; i++) out.push_back(i < 2 ? 250 : i % 11 < 5 ? 40 : i / kW % 9 < 4 ? 3 : 41);
  return out;
}

struct Input {
  ScratchDir dir;
  MapFiles files;
  std::vector<Vec3f> normals;

  explicit Input(const std::vector<int>& material_ids = ids()) {
    write_normals(dir / "n.png", SampleType::kUint8, kW, kH, bumpy_normals(kW, kH));
    write_ids(dir / "ids.png", kW, kH, material_ids);
    files = {dir / "n.png", dir / "ids.png"};
    int w, h;
    normals = read_normals(dir / "n.png", {}, &w, &h);
  }
};

void expect_own_material(const IndexedMap& map, const std::vector<int>& expected, const std::string& what) {
  for (std::size_t i = 0; i < expected.size(); i++)
    ASSERT_EQ(map.palette.materials[map.palette.interval_of(map.levels[0].data[i])].id, expected[i])
        << what << ", texel " << i;
}

TEST(PaletteEncoding, NoTexelChangesItsMaterialAndTakesTheNearestOfItsEntries) {
  const Input input;
  for (const MaterialEncoding encoding : kEncodings)
    for (const Engine engine : engines())
      for (const int n : {4, 5, 40, 200})
        for (const Dither dither : {Dither::kNone, Dither::kBlueNoise}) {
          QuantizeOptions options;
          options.normals = n;
          options.engine = engine;
          options.encoding = encoding;
          options.dither = dither;
          const QuantizedMap q = quantize_normal_map(input.files, options);
          const std::string what = "encoding " + std::to_string(int(encoding)) + " engine " +
                                   std::to_string(int(engine)) + " n " + std::to_string(n);
          ASSERT_EQ(q.map.palette.materials.size(), 4u) << what;  // one entry at least for two texels
          EXPECT_LE(q.stats.normals, n) << what;
          EXPECT_GE(q.stats.normals, engine == Engine::kImagequant ? n / 2 : n) << what;
          expect_own_material(q.map, ids(), what);
          if (dither != Dither::kNone) continue;
          for (std::size_t i = 0; i < input.normals.size(); i++) {
            const MaterialInterval& m = q.map.palette.materials[q.map.palette.interval_of(q.map.levels[0].data[i])];
            const std::span own = std::span(q.map.palette.normals).subspan(m.first, m.count);
            const Vec3f nearest = own[testing::brute_nearest(own, input.normals[i])];
            ASSERT_NEAR(angle_deg(input.normals[i], q.map.palette.normals[q.map.levels[0].data[i]]),
                        angle_deg(input.normals[i], nearest), 1e-3)
                << what;
          }
        }
}

TEST(PaletteEncoding, ComesCloseToSharesOfTheirOwn) {
  const Input input;
  QuantizeOptions options;
  options.normals = 200;
  const double split = quantize_normal_map(input.files, options).stats.rms_deg;
  for (const MaterialEncoding encoding : kEncodings) {
    options.encoding = encoding;
    const double rms = quantize_normal_map(input.files, options).stats.rms_deg;
    EXPECT_GT(rms, 0.98 * split) << "encoding " << int(encoding);
    EXPECT_LT(rms, 1.25 * split) << "encoding " << int(encoding);
  }
}

TEST(PaletteEncoding, WhereEveryNormalHasRoomNothingIsLost) {
  const ScratchDir dir;
  Random random(2);
  const std::vector<Vec3f> few = random.directions(30);
  std::vector<Vec3f> normals;
  std::vector<int> of;
  for (int i = 0; i < kW * kH; i++) normals.push_back(few[random.below(30)]), of.push_back(random.below(3));
  write_normals(dir / "n.exr", SampleType::kFloat, kW, kH, normals);  // finer than the cube
  write_ids(dir / "ids.png", kW, kH, of);
  for (const MaterialEncoding encoding : kEncodings)
    for (const Engine engine : engines()) {
      QuantizeOptions options;
      options.normals = 90;
      options.encoding = encoding;
      options.engine = engine;
      const QuantizedMap q = quantize_normal_map({dir / "n.exr", dir / "ids.png"}, options);
      EXPECT_TRUE(q.stats.lossless) << "encoding " << int(encoding) << " engine " << int(engine);
      EXPECT_EQ(q.stats.normals, 90);
    }
}

TEST(PaletteEncoding, ManyMaterialsEachHaveAnEntry) {
  std::vector<int> many;
  for (int i = 0; i < kW * kH; i++) many.push_back(i % 200);
  const Input input(many);
  for (const Engine engine : engines())
    for (const int n : {200, 230}) {
      QuantizeOptions options;
      options.normals = n;
      options.engine = engine;
      options.encoding = MaterialEncoding::kAlpha;
      const QuantizedMap q = quantize_normal_map(input.files, options);
      EXPECT_EQ(q.map.palette.materials.size(), 200u);
      EXPECT_LE(q.stats.normals, n);
      expect_own_material(q.map, many, "engine " + std::to_string(int(engine)));
    }
  QuantizeOptions options;
  options.normals = 199;
  options.encoding = MaterialEncoding::kAlpha;
  EXPECT_ERROR(quantize_normal_map(input.files, options), ErrorKind::kMalformed, "200 materials");
  options.encoding = MaterialEncoding::kSubcubes;
  options.normals = 256;
  EXPECT_ERROR(quantize_normal_map(input.files, options), ErrorKind::kUnsupported, "at most 4 materials, not 200");
}

TEST(PaletteEncoding, TheSmallestPaletteThatMeetsATarget) {
  const Input input;
  for (const MaterialEncoding encoding : kEncodings) {
    QuantizeOptions options;
    options.encoding = encoding;
    options.target_error_deg = 4;
    const QuantizedMap q = quantize_normal_map(input.files, options);
    EXPECT_LE(q.stats.rms_deg, 4);
    options.target_error_deg.reset();
    options.normals = q.stats.normals - 1;
    EXPECT_GT(quantize_normal_map(input.files, options).stats.rms_deg, 4) << "encoding " << int(encoding);
  }
}

// A quantizer of one's own: every colour to the nearest multiple of 16.
void coarsen(const std::string& from, const std::string& to) {
  Image image = read_image(from);
  for (std::size_t i = 0; i < image.data.size(); i++) {
    const int v = int(std::lround(image.data[i] * 255));
    const bool alpha = image.channels == 4 && i % 4 == 3;
    image.data[i] = float(alpha ? std::min(255, v + 20) : v / 16 * 16 + 8) / 255.f;  // alphas astray, yet nearest
  }
  write_image(to, FileType::kPng, SampleType::kUint8, image);
}

TEST(PaletteEncoding, PalettesOfOtherQuantizersAreReadBack) {
  const Input input;
  for (const MaterialEncoding encoding : kEncodings) {
    QuantizeOptions options;
    options.encoding = encoding;
    MapFiles files = input.files;
    files.rgb = input.dir / "rgb.png";
    quantize_normal_map(files, options);
    coarsen(files.rgb.path, input.dir / "q.png");
    options.palette = input.dir / "q.png";
    options.space = NormalSpace::kObject;
    const QuantizedMap q = quantize_normal_map(input.files, options);
    const MaterialCube cube(encoding, 4);
    const std::vector<Colour> colours = read_cube_colours(input.dir / "q.png", cube);
    EXPECT_EQ(q.map.palette.normals.size(), colours.size());
    EXPECT_EQ(q.map.palette.space, NormalSpace::kObject);
    expect_own_material(q.map, ids(), "encoding " + std::to_string(int(encoding)));
    // Steps of 16 in 8 bits, of 32 where a bit is lost: within half a step in each component, so is the nearest entry.
    const double step = encoding == MaterialEncoding::kAlpha ? 16 : 32;
    EXPECT_LT(q.stats.max_deg, degrees(std::sqrt(3.0) * (step / 2 + 1) / 127.5 * 1.3));
    for (const Colour& c : colours) {
      const MaterialCube::Meaning m = cube.decode(c);
      const MaterialInterval& interval = q.map.palette.materials[m.material];
      const auto begin = q.map.palette.normals.begin() + interval.first;
      EXPECT_NE(std::find(begin, begin + interval.count, m.normal), begin + interval.count);
    }
  }
}

TEST(PaletteEncoding, APaletteThatLacksAMaterialIsRefused) {
  const Input input;
  Image image(8, 1, 4);
  for (int i = 0; i < 8; i++) image.at(i, 0)[2] = image.at(i, 0)[3] = 1, image.at(i, 0)[0] = float(i) / 8;
  write_image(input.dir / "q.png", FileType::kPng, SampleType::kUint8, image);
  QuantizeOptions options;
  options.encoding = MaterialEncoding::kAlpha;
  options.palette = input.dir / "q.png";
  EXPECT_ERROR(quantize_normal_map(input.files, options), ErrorKind::kMalformed,
               "q.png': expected entries for material 40, got 3");
}

TEST(PaletteEncoding, ColoursNeedAnEncoding) {
  const Input input;
  MapFiles files = input.files;
  files.rgb = input.dir / "rgb.png";
  EXPECT_ERROR(quantize_normal_map(files, {}), ErrorKind::kUsage, "alpha or subcubes");
}

TEST(PaletteEncoding, WhatIsMaskedShapesNoPalette) {
  const Input input;
  std::vector<int> mask;
  std::vector<Vec3f> normals = bumpy_normals(kW, kH);
  Random random(6);
  for (Vec3f& n : normals) {
    mask.push_back(random.below(2));
    if (!mask.back()) n = Vec3f{-n.x, -n.y, -n.z};  // the other hemisphere
  }
  write_normals(input.dir / "n.png", SampleType::kUint8, kW, kH, normals);
  write_ids(input.dir / "mask.png", kW, kH, mask);
  for (const MaterialEncoding encoding : kEncodings) {
    QuantizeOptions options;
    options.encoding = encoding;
    options.normals = 60;
    MapFiles files = input.files;
    files.mask = input.dir / "mask.png";
    files.rgb = input.dir / "rgb.png";
    const QuantizedMap q = quantize_normal_map(files, options);
    for (const Vec3f& n : q.map.palette.normals) EXPECT_GT(n.z, 0);
    const MaterialCube cube(encoding, int(q.map.palette.materials.size()));
    for (const Colour& c : read_cube_colours(files.rgb, cube)) EXPECT_GT(cube.decode(c).normal.z, 0);
  }
}

TEST(PaletteEncoding, OneColourIsTheMeanWhateverTheEngine) {
  if (!has_imagequant()) GTEST_SKIP() << "no libimagequant";
  const std::vector<WeightedColour> points{{{10, 20, 30, 255}, 3}, {{50, 60, 70, 255}, 1}};
  const std::vector<Colour> one = fit_imagequant(points, 1);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0], (Colour{20, 30, 40, 255}));
}

}  // namespace
}  // namespace burnish
