// Material textures: that the models can be evaluated from them, and from their files.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/ward.h"
#include "burnish/material/bake_material.h"
#include "expect_error.h"
#include "on_threads.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;
using enum MaterialModel;

constexpr MaterialModel kModels[] = {kBanks, kBlinnPhong, kWard};

// Bumps, directions, and parameters of which no two texels share one.
struct Source {
  ScratchDir dir;
  int w = 23, h = 17;
  MaterialSource source;

  explicit Source(MaterialModel model) {
    Random random(7);
    Image normals(w, h, 3), directions(w, h, 3), parameter(w, h, 3);
    const auto put = [](float* to, Vec3f v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; };
    for (std::size_t i = 0; i < normals.texels(); i++) {
      put(&normals.data[3 * i], random.in_cap(50));
      put(&directions.data[3 * i], random.direction() * float(0.1 + 3 * random.unit()));
      put(&parameter.data[3 * i], {float(0.25 + 0.75 * random.unit()), 7, 7});
    }
    write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, normals);
    write_image(dir / "t.exr", FileType::kExr, SampleType::kFloat, directions);
    write_image(dir / "p.exr", FileType::kExr, SampleType::kFloat, parameter);
    source.model = model;
    source.alpha_x.map = source.k_s.map = dir / "p.exr";
    source.alpha_y.number = 0.5f;
    source.exponent.number = 20;
    source.directions = dir / "t.exr";
    source.normals = dir / "n.exr";
  }
  MaterialTextures through_files(const MaterialMaps& maps, const BakeOptions& options, FileType type) const {
    FileRef file[3];
    for (int i = 0; i < 3; i++) file[i] = material_file(dir / "m", "tbn"[i], type);
    write_material_textures(bake_material(maps, options).textures, file[0], file[1], file[2], type, options.sample);
    const auto written = [&](char which) { return FileRef(material_file(dir / "m", which)); };
    const MaterialTextures read = read_material_textures(written('t'), written('b'), written('n'));
    for (const FileRef& f : file) std::filesystem::remove(f.path);
    return read;
  }
};

struct Storage {
  VectorRange range;
  FileType type;
  SampleType sample;
  double error;  // of a stored value
};
constexpr Storage kStorages[] = {
    {VectorRange::kFloat, FileType::kExr, SampleType::kFloat, 1e-7},
    {VectorRange::kFloat, FileType::kExr, SampleType::kHalf, 1 / 1024.},
    {VectorRange::kFloat, FileType::kTiff, SampleType::kFloat, 1e-7},
    {VectorRange::kCombiner, FileType::kExr, SampleType::kFloat, 1e-7},
    {VectorRange::kCombiner, FileType::kExr, SampleType::kHalf, 1 / 4096.},
    {VectorRange::kCombiner, FileType::kTiff, SampleType::kUint16, 0.51 / 65535},
    {VectorRange::kCombiner, FileType::kPng, SampleType::kUint16, 0.51 / 65535},
    {VectorRange::kCombiner, FileType::kPng, SampleType::kUint8, 0.51 / 255},
};

TEST(MaterialTextures, HoldTheFrameAndTheParametersOfEveryModelInEveryFile) {
  for (const MaterialModel model : kModels) {
    const Source source(model);
    const MaterialMaps maps = read_material_maps(source.source);
    for (const Storage& storage : kStorages) {
      const std::string what = std::string(name(model)) + " in " + name(storage.type) + " " + name(storage.sample);
      const MaterialTextures m = source.through_files(maps, {storage.range, 0.25, false, storage.sample}, storage.type);
      ASSERT_EQ(m.model, model);
      ASSERT_EQ(m.width(), source.w);
      ASSERT_EQ(m.height(), source.h);
      const auto error = [&](const MaterialTexture& t, int c) { return 1.01 * storage.error * t.scale[c]; };
      for (int y = 0; y < source.h; y++)
        for (int x = 0; x < source.w; x++) {
          const std::size_t i = std::size_t(y) * source.w + x;
          const double k_s = maps.k_s.at(i), ax = model == kBanks ? 1 : maps.alpha_x.at(i),
                       ay = model == kBanks ? 1 : 0.5;
          const Vec3d n(m.n.vector(0, x, y)), t = Vec3d(m.t.vector(0, x, y)) * ax, b = Vec3d(m.b.vector(0, x, y)) * ay;
          // Components of stored floats are as large as 4.
          const double et = std::sqrt(3) * error(m.t, 0) * (storage.range == VectorRange::kFloat ? 4 : ax),
                       eb = std::sqrt(3) * error(m.b, 0) * (storage.range == VectorRange::kFloat ? 4 : ay),
                       en = std::sqrt(3) * error(m.n, 0), e = 1.5 * (et + eb + en) + 1e-6;
          ASSERT_LT(length(t - Vec3d(maps.t[i])), et + 1e-6) << what;
          ASSERT_LT(length(n - Vec3d(maps.n[i])), en + 1e-6) << what;
          for (const double d : {dot(t, n), dot(b, n), dot(t, b), length(t) - 1, length(b) - 1, length(n) - 1})
            ASSERT_LT(std::abs(d), e) << what;
          ASSERT_GT(dot(cross(n, t), b), 1 - 2 * e) << what << ": right-handed";
          if (model != kWard) {
            ASSERT_NEAR(m.t.alpha(0, x, y), k_s, error(m.t, 3) + 1e-6) << what;
          }
          if (model == kBlinnPhong) {
            ASSERT_NEAR(m.b.alpha(0, x, y), 20, error(m.b, 3) + 1e-5) << what;
          }
          if (model == kWard) {
            ASSERT_NEAR(m.n.alpha(0, x, y), k_s / (4 * kPi * ax * ay), error(m.n, 3) + 1e-6) << what;
          }
        }
      EXPECT_EQ(m.t.channels() + m.b.channels() + m.n.channels(), model == kBlinnPhong ? 11 : 10);
    }
  }
}

TEST(MaterialTextures, FloatFramesAreOrthonormal) {
  const Source source(kWard);
  const MaterialMaps maps = read_material_maps(source.source);
  const MaterialTextures m =
      source.through_files(maps, {VectorRange::kFloat, 0.25, false, SampleType::kFloat}, FileType::kExr);
  for (int y = 0; y < source.h; y++)
    for (int x = 0; x < source.w; x++) {
      const double ax = maps.alpha_x.at(std::size_t(y) * source.w + x);
      const Vec3d t = Vec3d(m.t.vector(0, x, y)) * ax, b = Vec3d(m.b.vector(0, x, y)) * 0.5, n(m.n.vector(0, x, y));
      for (const double d : {dot(t, n), dot(b, n), dot(t, b), length(t) - 1, length(b) - 1, length(n) - 1})
        ASSERT_LT(std::abs(d), 1e-6);
      ASSERT_GT(dot(cross(n, t), b), 1 - 1e-6);
    }
}

// Sections 3.1 to 3.3, with what a shader has: dot products with the stored vectors, and the fourth channels.
TEST(MaterialTextures, EachModelIsEvaluatedFromThem) {
  Random random(5);
  for (const MaterialModel model : kModels) {
    const Source source(model);
    const MaterialMaps maps = read_material_maps(source.source);
    const MaterialTextures m = bake_material(maps, {VectorRange::kFloat, 0.25, false, SampleType::kFloat}).textures;
    for (int y = 0; y < source.h; y++)
      for (int x = 0; x < source.w; x++) {
        const std::size_t i = std::size_t(y) * source.w + x;
        const Vec3d t(m.t.vector(0, x, y)), b(m.b.vector(0, x, y)), n(m.n.vector(0, x, y));
        const LocalFrame frame{Vec3d(maps.t[i]), cross(Vec3d(maps.n[i]), Vec3d(maps.t[i])), Vec3d(maps.n[i])};
        const Vec3d l(random.in_cap(60)), v(random.in_cap(60)), h = normalized(l + v);
        const double k_s = maps.k_s.at(i), ax = maps.alpha_x.at(i), th = dot(t, h), bh = dot(b, h);
        const double e = std::max(0., 1 - th * th - bh * bh), lit = std::max(0., dot(n, l));
        if (model == kBanks) {
          EXPECT_NEAR(m.t.alpha(0, x, y) * lit * banks_fibre(dot(v, t), dot(l, t), banks_r), banks(frame, k_s, l, v),
                      1e-5);
        }
        if (model == kBlinnPhong && dot(h, n) > 0) {
          EXPECT_NEAR(m.t.alpha(0, x, y) * blinn_phong_f(m.b.alpha(0, x, y), e),
                      blinn_phong(frame, {k_s, ax, 0.5, 20}, h), 1e-5);
        }
        if (model == kWard && lit > 0 && dot(n, v) > 0) {
          EXPECT_NEAR(m.n.alpha(0, x, y) * ward_s(lit * dot(n, v)) * ward_e(th * th + bh * bh, dot(h, n)) * lit /
                          ward(frame, {k_s, ax, 0.5}, l, v),
                      1, 1e-4);
        }
      }
  }
}

// A single texel: t along 90°, against no bumps.
MaterialMaps texel(MaterialModel model, float alpha_x, float alpha_y, float k_s = 1, float exponent = 32) {
  MaterialSource source;
  source.model = model;
  source.alpha_x.number = alpha_x, source.alpha_y.number = alpha_y;
  source.k_s.number = k_s, source.exponent.number = exponent;
  source.angle_rad = radians(90);
  return read_material_maps(source);
}

TEST(MaterialTextures, TheCombinerRangeIsThePapers) {
  const MaterialTextures m = bake_material(texel(kBlinnPhong, 0.25f, 0.5f, 0.5f, 64), {}).textures;
  EXPECT_EQ(m.width() * m.height(), 1);
  EXPECT_EQ(m.t.scale, (std::array<float, 4>{8, 8, 8, 1}));
  EXPECT_EQ(m.t.bias, (std::array<float, 4>{-4, -4, -4, 0}));
  EXPECT_EQ(m.b.scale, (std::array<float, 4>{8, 8, 8, 128}));
  EXPECT_EQ(m.n.scale, (std::array<float, 4>{2, 2, 2, 1}));
  EXPECT_EQ(m.n.bias, (std::array<float, 4>{-1, -1, -1, 0}));
  EXPECT_NEAR(m.t.levels[0].data[1], 1, 1e-7);     // (0,1,0) / 0.25
  EXPECT_NEAR(m.b.levels[0].data[0], 0.25, 1e-7);  // (−1,0,0) / 0.5
  EXPECT_EQ(m.t.levels[0].data[3], 0.5f);
  EXPECT_EQ(m.b.levels[0].data[3], 0.5f);
  EXPECT_EQ(m.n.levels[0].data[2], 1.f);
  // The others that ×2 and ×1 undo; Banks' vectors, divided by nothing, keep the whole range.
  EXPECT_EQ(bake_material(texel(kWard, 0.5f, 1), {VectorRange::kCombiner, 0.5}).textures.t.scale[0], 4);
  EXPECT_EQ(bake_material(texel(kWard, 1, 1), {VectorRange::kCombiner, 1}).textures.t.bias[0], -1);
  const BakedMaterial banks = bake_material(texel(kBanks, 0, 0), {});
  EXPECT_EQ(banks.textures.t.scale[0], 2);
  EXPECT_EQ(banks.textures.b.bias[2], -1);
  EXPECT_EQ(banks.stats.scale, 1);
  EXPECT_NEAR(banks.stats.max_component, 1, 1e-7);
  EXPECT_NEAR(bake_material(texel(kWard, 0.25f, 0.5f), {}).stats.max_component, 4, 1e-6);
  EXPECT_EQ(bake_material(texel(kWard, 3, 0.5f), {}).stats.scale, 0.25);  // α above 1 is as good as any
}

TEST(MaterialTextures, WardsAlphaIsDividedByItsMaximum) {
  const Source source(kWard);
  const BakedMaterial baked = bake_material(read_material_maps(source.source), {});
  float most = 0;
  for (int i = 0; i < source.w * source.h; i++) most = std::max(most, baked.textures.n.levels[0].data[4 * i + 3]);
  EXPECT_EQ(most, 1);
  EXPECT_NEAR(bake_material(texel(kWard, 0.5f, 0.5f, 30), {}).textures.n.scale[3], 30 / kPi, 1e-5);
  EXPECT_EQ(bake_material(texel(kWard, 0.5f, 0.5f, 0), {}).textures.n.alpha(0, 0, 0), 0);
}

TEST(MaterialTextures, WhatDoesNotFitIsAnError) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float bad : {0.f, -0.5f, nan, inf}) {
    const std::string wanted =
        bad == inf ? "expected a finite number above 0, got inf" : "expected a number above 0, got";
    EXPECT_ERROR(texel(kWard, bad, 1), ErrorKind::kUsage, "alpha-x: " + wanted);
    EXPECT_ERROR(texel(kBlinnPhong, 1, bad), ErrorKind::kUsage, "alpha-y: " + wanted);
  }
  EXPECT_NO_THROW(texel(kBanks, 0, nan));
  EXPECT_ERROR(texel(kWard, 1, 1, -1), ErrorKind::kUsage, "ks: expected a number of at least 0, got -1");
  EXPECT_ERROR(texel(kBlinnPhong, 1, 1, 1, nan), ErrorKind::kUsage, "exponent: expected a number of at least 0");
  EXPECT_ERROR(bake_material(texel(kWard, 0.2f, 1), {}), ErrorKind::kUsage,
               "alpha-x: expected at least 0.25 for the combiner range, got 0.2");
  EXPECT_ERROR(bake_material(texel(kWard, 1, 0.25f), {VectorRange::kCombiner, 0.5}), ErrorKind::kUsage,
               "alpha-y: expected at least 0.5");
  const BakeOptions half{VectorRange::kFloat, 0.25, false, SampleType::kHalf};
  const BakeOptions single{VectorRange::kFloat, 0.25, false, SampleType::kFloat};
  EXPECT_ERROR(bake_material(texel(kWard, 1e-5f, 1), half), ErrorKind::kUsage, "in half samples, got 1e-05");
  EXPECT_NO_THROW(bake_material(texel(kWard, 1e-5f, 1), single));
  EXPECT_ERROR(bake_material(texel(kWard, 1e-30f, 1e-30f), single), ErrorKind::kMalformed, "single precision");
  EXPECT_ERROR(bake_material(texel(kBanks, 1, 1, 1.5f), {}), ErrorKind::kUsage, "ks: expected at most 1 in uint8");
  EXPECT_ERROR(bake_material(texel(kBanks, 1, 1, 1e5f), half), ErrorKind::kUsage, "ks: expected at most 65504 in half");
  EXPECT_NO_THROW(bake_material(texel(kBanks, 1, 1, 1e5f), single));
  EXPECT_NO_THROW(bake_material(texel(kWard, 1, 1, 1e5f), {}));
  EXPECT_ERROR(bake_material(texel(kBlinnPhong, 1, 1, 1, 129), {}), ErrorKind::kUsage,
               "exponent: expected at most 128 in uint8 samples, got 129");
  EXPECT_NO_THROW(bake_material(texel(kBlinnPhong, 1, 1, 1, 129), half));
  EXPECT_ERROR(bake_material(texel(kWard, 1, 1), {VectorRange::kFloat, 0.25, false, SampleType::kUint8}),
               ErrorKind::kUsage, "encode: float needs half or float samples");
}

TEST(MaterialTextures, AlphaIsClampedAndCounted) {
  const ScratchDir dir;
  Image alpha(4, 1);
  alpha.data = {0.1f, 0.25f, 1, 0.2f};
  write_image(dir / "a.exr", FileType::kExr, SampleType::kFloat, alpha);
  MaterialSource source;
  source.alpha_x.map = dir / "a.exr";
  source.alpha_y.number = 0.5f;
  const MaterialMaps maps = read_material_maps(source);
  EXPECT_ERROR(bake_material(maps, {}), ErrorKind::kMalformed,
               "a.exr': expected at least 0.25 for the combiner range, got 0.1 at column 0, row 0");
  const BakedMaterial baked = bake_material(maps, {VectorRange::kCombiner, 0.25, true});
  EXPECT_EQ(baked.stats.clamped_texels, 2u);
  for (int x = 0; x < 4; x++) {
    const float ax = std::max(0.25f, alpha.data[x]);
    EXPECT_NEAR(baked.textures.t.vector(0, x, 0).x, 1 / ax, 1e-6);
    EXPECT_NEAR(baked.textures.n.alpha(0, x, 0), 1 / (4 * kPi * ax * 0.5), 1e-6);
  }
}

TEST(MaterialMaps, AParameterIsANumberOrAMap) {
  const ScratchDir dir;
  SharedSize size;
  EXPECT_EQ(read_parameter("ks", {0.5f, {}}, size).at(1000), 0.5f);
  Image map(2, 2, 3);
  map.data = {0, 9, 9, 0.2f, 9, 9, 0.4f, 9, 9, 1, 9, 9};
  write_image(dir / "first.exr", FileType::kExr, SampleType::kFloat, map);
  const Parameter first = read_parameter("ks", {7, dir / "first.exr"}, size);
  EXPECT_EQ(first.values, (std::vector<float>{0, 0.2f, 0.4f, 1}));
  write_image(dir / "scaled.png", FileType::kPng, SampleType::kUint8, map,
              {{"burnish:scale", std::vector<double>{128, 1, 1}}, {"burnish:bias", std::vector<double>{-1}}});
  const Parameter scaled = read_parameter("ks", {7, dir / "scaled.png"}, size);
  EXPECT_FLOAT_EQ(scaled.at(1), 51 / 255.f * 128 - 1);
  write_image(dir / "other.png", FileType::kPng, SampleType::kUint8, Image(3, 2));
  EXPECT_ERROR(read_parameter("ks", {7, dir / "other.png"}, size), ErrorKind::kMalformed,
               "other.png': expected 2x2 texels as in '" + (dir / "first.exr") + "', got 3x2");
  MaterialSource source;
  source.alpha_x.map = dir / "first.exr";
  EXPECT_ERROR(read_material_maps(source), ErrorKind::kMalformed,
               "first.exr': expected a number above 0, got 0 at column 0, row 0");
}

TEST(MaterialMaps, HaveOneSize) {
  const Source source(kWard);
  const ScratchDir dir;
  write_image(dir / "small.png", FileType::kPng, SampleType::kUint8, Image(5, 5, 3));
  for (FileRef MaterialSource::*map : {&MaterialSource::directions, &MaterialSource::normals}) {
    MaterialSource broken = source.source;
    broken.*map = dir / "small.png";
    EXPECT_ERROR(read_material_maps(broken), ErrorKind::kMalformed, "small.png': expected 23x17 texels as in '");
  }
}

TEST(MaterialMaps, ADirectionAlongTheNormalIsFilledAndCounted) {
  const ScratchDir dir;
  Image normals(3, 1, 3);
  normals.data = {0, 0, 1, 1, 0, 0, 0, 0, 0};
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, normals);
  MaterialSource source;
  source.alpha_x.number = source.alpha_y.number = 1;
  source.normals = dir / "n.exr";
  MaterialMaps maps = read_material_maps(source);
  EXPECT_EQ(maps.degenerate_texels, 1u);
  EXPECT_EQ(maps.invalid_normal_texels, 1u);
  EXPECT_EQ(maps.n[2], (Vec3f{0, 0, 1}));
  EXPECT_EQ(maps.t[1], (Vec3f{0, 0, -1}));
  normals.data = {1, 0, 0, -1, 0, 0, 2, 0, 0};
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, normals);
  EXPECT_ERROR(read_material_maps(source), ErrorKind::kMalformed, "n.exr': expected directions, got none");
}

TEST(MaterialTextures, AreTheSameOnAnyNumberOfThreads) {
  const Source source(kBlinnPhong);
  const auto make = [&] {
    const MaterialTextures m = bake_material(read_material_maps(source.source), {}).textures;
    return std::vector{m.t.levels[0].data, m.b.levels[0].data, m.n.levels[0].data};
  };
  EXPECT_EQ(on_threads(1, make), on_threads(4, make));
}

}  // namespace
}  // namespace burnish
