// Directions of anisotropy: their forms, their turns, and that they are orthogonal to normals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/material/directions/convert_directions.h"
#include "burnish/material/directions/nearest_directions.h"
#include "burnish/material/directions/orthonormal_directions.h"
#include "burnish/material/directions/turned_directions.h"
#include "burnish/mesh/bake/gutter.h"
#include "expect_error.h"
#include "on_threads.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using namespace testing;
using enum DirectionForm;

constexpr SampleType kSamples[] = {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat};

void write_samples(const std::string& file, SampleType sample, int w, int h, int channels, std::vector<float> samples) {
  Image image(w, h, channels);
  image.data = std::move(samples);
  write_image(file, file_type_of(file), sample, image);
}

DirectionMap map_of(int w, int h, std::vector<Vec3f> vectors) { return {"map", w, h, std::move(vectors), 0, {}}; }

// Round the centre, counter-clockwise.
DirectionMap swirl(int w, int h) {
  DirectionMap map = map_of(w, h, {});
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      map.vectors.push_back({float(y + 0.5 - 0.5 * h), float(x + 0.5 - 0.5 * w), float(x * x + y)});
  return map;
}

void expect_near(Vec3f a, Vec3f b, double most, const std::string& what) {
  EXPECT_LE(length(a - b), most) << what << ": (" << a.x << " " << a.y << " " << a.z << ") and (" << b.x << " " << b.y
                                 << " " << b.z << ")";
}

TEST(Directions, EachFormIsReadAsItIsDefined) {
  const ScratchDir dir;
  const auto read = [&](const std::string& file, const DirectionCoding& coding) {
    return read_direction_map(dir / file, coding).vectors[0];
  };
  write_samples(dir / "quarter.exr", SampleType::kFloat, 1, 1, 1, {0.25f});
  expect_near(read("quarter.exr", {kAngle}), {0, 1, 0}, 1e-7, "a quarter turn counter-clockwise is up");
  write_samples(dir / "turns.exr", SampleType::kFloat, 1, 1, 1, {-2.125f});
  expect_near(read("turns.exr", {kAngle, GreenAxis::kDown}), {std::sqrt(0.5f), -std::sqrt(0.5f), 0}, 1e-6,
              "angles have no green");
  write_samples(dir / "v.exr", SampleType::kFloat, 1, 1, 4, {3, -4, 12, 9});
  EXPECT_EQ(read("v.exr", {kVector}), (Vec3f{3, -4, 12}));
  EXPECT_EQ(read("v.exr", {kVector, GreenAxis::kDown}), (Vec3f{3, 4, 12}));
  EXPECT_EQ(read("v.exr", {kVector, GreenAxis::kUp, NormalEncoding::kBiased}), (Vec3f{5, -9, 23}));
  EXPECT_EQ(read("v.exr", {kFlow}), (Vec3f{3, -4, 0}));
  write_samples(dir / "v.png", SampleType::kUint16, 1, 1, 3, {1, 0, 0.25f});
  expect_near(read("v.png", {kVector}), {1, -1, -0.5f}, 2e-5, "biased in integers");
  expect_near(read("v.png", {kFlow}), {1, -1, 0}, 1e-6, "flow");
  EXPECT_EQ(read("v.png", {kKhr, GreenAxis::kDown}), (Vec3f{1, 1, 0}));
  EXPECT_NEAR(read_direction_map(dir / "v.png", {kKhr}).strengths[0], 0.25, 1e-5);
  write_samples(dir / "khr.exr", SampleType::kFloat, 1, 1, 3, {1, 0.5f, 1});  // glTF's default
  EXPECT_EQ(read("khr.exr", {kKhr}), (Vec3f{1, 0, 0}));
  EXPECT_EQ(read("khr.exr", {kKhr, GreenAxis::kUp, NormalEncoding::kSigned}), (Vec3f{1, 0.5f, 0}));
}

TEST(Directions, WhatIsWrittenIsReadBackToThePrecisionOfItsSamples) {
  DirectionMap map = map_of(64, 1, {});
  for (int i = 0; i < 64; i++) {
    const double a = 2 * kPi * i / 64;
    map.vectors.push_back(Vec3f(Vec3d{std::cos(a), std::sin(a), 0}));
    map.strengths.push_back(float(i) / 63);
  }
  for (const SampleType sample : kSamples)
    for (const DirectionForm form : {kVector, kAngle, kKhr})
      for (const GreenAxis green : {GreenAxis::kUp, GreenAxis::kDown})
        for (const NormalEncoding encoding :
             {NormalEncoding::kByType, NormalEncoding::kBiased, NormalEncoding::kSigned}) {
          if (is_integer(sample) && encoding == NormalEncoding::kSigned) continue;
          const DirectionCoding coding{form, green, encoding};
          const DirectionMap back = decode_directions("back", encode_directions(map, coding, sample), coding, sample);
          const double step = sample == SampleType::kUint8    ? 2 / 255.
                              : sample == SampleType::kUint16 ? 2 / 65535.
                              : sample == SampleType::kHalf   ? 1 / 1024.
                                                              : 3e-7;
          for (int i = 0; i < 64; i++)
            expect_near(back.vectors[i], map.vectors[i], step * (form == kAngle ? 1.6 : 1),
                        std::string(name(sample)) + " " + name(form) + " " + std::to_string(i));
          ASSERT_EQ(back.strengths.size(), form == kKhr ? 64u : 0u);
          if (form == kKhr) {
            EXPECT_NEAR(back.strengths[31], 31 / 63., step);
          }
        }
}

TEST(Directions, FilesThatHoldNone) {
  const ScratchDir dir;
  write_samples(dir / "one.exr", SampleType::kFloat, 1, 1, 1, {0});
  write_samples(dir / "two.exr", SampleType::kFloat, 1, 1, 2, {0, 1});
  write_samples(dir / "three.png", SampleType::kUint8, 1, 1, 3, {0, 0, 0});
  EXPECT_ERROR(read_direction_map(dir / "two.exr", {kVector}), ErrorKind::kMalformed,
               "two.exr': expected 3 channels of directions as vector, got 2");
  EXPECT_ERROR(read_direction_map(dir / "two.exr", {kKhr}), ErrorKind::kMalformed, "3 channels");
  EXPECT_ERROR(read_direction_map(dir / "one.exr", {kFlow}), ErrorKind::kMalformed, "2 channels");
  EXPECT_ERROR(read_direction_map(dir / "three.png", {kAngle}), ErrorKind::kMalformed, "expected 1 channel of");
  EXPECT_ERROR(read_direction_map(dir / "three.png", {kFlow, GreenAxis::kUp, NormalEncoding::kSigned}),
               ErrorKind::kUnsupported, "signed");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<float> samples(4 * 3 * 3, 0.5f);
    samples[(2 * 4 + 3) * 3 + 1] = bad;
    write_samples(dir / "bad.exr", SampleType::kFloat, 4, 3, 3, samples);
    for (const DirectionForm form : {kVector, kFlow, kKhr})
      EXPECT_ERROR(read_direction_map(dir / "bad.exr", {form}), ErrorKind::kMalformed, "at column 3, row 2");
  }
  for (const float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    write_samples(dir / "bad.exr", SampleType::kFloat, 1, 1, 3, {1, 1, bad});
    EXPECT_ERROR(read_direction_map(dir / "bad.exr", {kKhr}), ErrorKind::kMalformed, "column 0, row 0");
    EXPECT_NO_THROW(read_direction_map(dir / "bad.exr", {kFlow}));  // which has no third
  }
  write_image(dir / "object.exr", FileType::kExr, SampleType::kHalf, Image(1, 1, 3), {{"burnish:space", "object"}});
  EXPECT_ERROR(read_direction_map(dir / "object.exr", {}), ErrorKind::kMalformed, "tangent space");
  EXPECT_ERROR(read_surface_normals(dir / "object.exr", {}), ErrorKind::kMalformed, "tangent space");
}

// What one tool wrote as khr is not another's vectors.
TEST(Directions, FilesThatSayTheyHoldAnotherForm) {
  const ScratchDir dir;
  write_samples(dir / "v.exr", SampleType::kFloat, 2, 1, 3, {1, 0.5f, 0.25f, 0.5f, 1, 1});
  for (const DirectionForm form : {kVector, kKhr}) {
    const std::string file = dir / (std::string(name(form)) + ".tif"), other = form == kKhr ? "vector" : "khr";
    convert_directions({dir / "v.exr", {kVector}, {}, {}, {}}, {file, FileType::kTiff, SampleType::kUint16, {form}});
    EXPECT_NO_THROW(read_direction_map(file, {form}));
    EXPECT_ERROR(read_direction_map(file, {form == kKhr ? kVector : kKhr}), ErrorKind::kMalformed,
                 std::string(name(form)) + ".tif': expected directions as " + other + ", got " + name(form) +
                     ": burnish-tangents reads it --from " + name(form) + " and writes it --to " + other);
    EXPECT_ERROR(read_direction_map(file, {kFlow}), ErrorKind::kMalformed, "expected directions as flow, got");
  }
  convert_directions({dir / "v.exr", {kVector}, {}, {}, {}},
                     {dir / "a.exr", FileType::kExr, SampleType::kHalf, {kAngle}});
  EXPECT_NO_THROW(read_direction_map(dir / "a.exr", {kAngle}));
  EXPECT_ERROR(read_direction_map(dir / "a.exr", {kVector}), ErrorKind::kMalformed, "got angle");
  write_image(dir / "lut.exr", FileType::kExr, SampleType::kHalf, Image(4, 4, 4), {{"burnish:function", "strand"}});
  for (const DirectionForm form : {kVector, kFlow, kKhr})
    EXPECT_ERROR(read_direction_map(dir / "lut.exr", {form}), ErrorKind::kMalformed, "got a lookup table of strand");
}

TEST(DirectionTurns, AFieldThatLooksTheSameTurnedIsTheSameTurned) {
  DirectionMap map = swirl(6, 6);
  for (Vec3f& v : map.vectors) v.z = 1;
  for (const int quarters : {-1, 1, 2, 3, 4, 7}) EXPECT_EQ(turned(map, {false, false, quarters}).vectors, map.vectors);
  // A mirror turns the swirl the other way.
  for (const DirectionTurns& mirror : {DirectionTurns{true, false, 0}, DirectionTurns{false, true, 0}}) {
    const DirectionMap other = turned(map, mirror);
    for (std::size_t i = 0; i < map.vectors.size(); i++)
      EXPECT_EQ(other.vectors[i], (Vec3f{-map.vectors[i].x, -map.vectors[i].y, 1}));
  }
}

TEST(DirectionTurns, CounterClockwiseWithTheirTexels) {
  // a b c      c' f'
  // d e f  →   b' e'
  //            a' d'
  DirectionMap map = map_of(3, 2, {{1, 2, 3}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}});
  map.strengths = {1, 2, 3, 4, 5, 6};
  const DirectionMap one = turned(map, {false, false, 1});
  EXPECT_EQ(one.width, 2);
  EXPECT_EQ(one.height, 3);
  EXPECT_EQ(one.strengths, (std::vector<float>{3, 6, 2, 5, 1, 4}));
  EXPECT_EQ(one.vectors[4], (Vec3f{-2, 1, 3}));
  EXPECT_EQ(one.vectors[0], (Vec3f{0, 3, 0}));
  const DirectionMap flipped = turned(map, {true, false, 1});
  EXPECT_EQ(flipped.strengths, (std::vector<float>{1, 4, 2, 5, 3, 6}));
  EXPECT_EQ(flipped.vectors[0], (Vec3f{-2, -1, 3}));
  // Both flips are half a turn; four quarters, and two flips, none.
  EXPECT_EQ(turned(map, {true, true, 0}).vectors, turned(map, {false, false, 2}).vectors);
  EXPECT_EQ(turned(turned(map, {false, true, 0}), {false, true, 0}).vectors, map.vectors);
  DirectionMap round = map;
  for (int i = 0; i < 4; i++) round = turned(round, {false, false, 1});
  EXPECT_EQ(round.vectors, map.vectors);
}

// Bands of any height are those of the whole map turned.
TEST(TurnedDirections, AreThoseOfTheWholeMap) {
  const ScratchDir dir;
  Random random(11);
  const std::pair<int, int> sizes[] = {{1, 1}, {5, 3}, {127, 65}, {65, 130}, {200, 64}};
  for (const auto& [w, h] : sizes) {
    std::vector<float> samples;
    for (int i = 0; i < w * h * 3; i++) samples.push_back(float(random.unit()));
    write_samples(dir / "k.exr", SampleType::kFloat, w, h, 3, samples);
    const DirectionMap map = read_direction_map(dir / "k.exr", {kKhr});
    for (const bool flip_u : {false, true})
      for (const bool flip_v : {false, true})
        for (int quarters = -1; quarters < 3; quarters++) {
          const DirectionTurns turns{flip_u, flip_v, quarters};
          const DirectionMap all = turned(map, turns);
          for (const int at_once : {1, 50, 64, 200}) {
            TurnedDirections reader(dir / "k.exr", {kKhr}, turns, dir.path());
            ASSERT_EQ(reader.width(), all.width);
            ASSERT_EQ(reader.height(), all.height);
            std::vector<Vec3f> vectors;
            std::vector<float> strengths;
            for (int y = 0; y < all.height; y += at_once) {
              const DirectionMap band = reader.rows(y, std::min(at_once, all.height - y));
              vectors.insert(vectors.end(), band.vectors.begin(), band.vectors.end());
              strengths.insert(strengths.end(), band.strengths.begin(), band.strengths.end());
            }
            EXPECT_EQ(vectors, all.vectors) << w << "x" << h << " " << flip_u << flip_v << quarters << " " << at_once;
            EXPECT_EQ(strengths, all.strengths) << w << "x" << h;
          }
        }
  }
  EXPECT_EQ(dir.entries(), 1u);  // the map alone
}

TEST(TurnedDirections, SayWhereAFileIsWrong) {
  const ScratchDir dir;
  std::vector<float> samples(4 * 3 * 3, 0.5f);
  samples[(2 * 4 + 3) * 3] = std::numeric_limits<float>::quiet_NaN();
  write_samples(dir / "bad.exr", SampleType::kFloat, 4, 3, 3, samples);
  TurnedDirections reader(dir / "bad.exr", {}, {false, false, 1}, dir.path());
  EXPECT_ERROR(reader.rows(0, 1), ErrorKind::kMalformed, "at column 3, row 2");
}

// The sources of gutters, which see the whole map, are the nearest directions of its rows; also where runs are more
// than memory takes.
TEST(NearestDirections, AreTheSourcesOfGutters) {
  const ScratchDir dir;
  Random random(13);
  const std::pair<int, int> sizes[] = {{1, 1}, {5, 3}, {127, 65}, {1, 40}, {40, 1}, {1500, 1500}};
  for (const auto& [w, h] : sizes)
    for (const double filled : {0.02, 0.5, 0.9}) {
      ByteImage defined(w, h);
      std::vector<Vec3f> t, n;
      for (int i = 0; i < w * h; i++) {
        defined.data[i] = random.unit() < filled;
        t.push_back({float(i % w), float(i / w), 0}), n.push_back({0, float(i), 1});
      }
      defined.data[random.below(w * h)] = 1;
      const std::vector<std::uint32_t> sources = gutter_sources(defined, w + h);
      const auto row = [&](int y) {
        return DirectionRow{defined.row(y), &t[std::size_t(y) * w], &n[std::size_t(y) * w]};
      };
      NearestDirections nearest(w, dir.path());
      for (int y = 0; y < h; y++) nearest.note(row(y));
      nearest.end_notes();
      EXPECT_EQ(nearest.missing(), std::size_t(std::ranges::count(defined.data, 0)));
      for (int y = 0; y < h; y++) {
        const DirectionRow above = y > 0 ? row(y - 1) : DirectionRow{};
        nearest.enter(y, row(y), y > 0 ? &above : nullptr);
        for (int x = 0; x < w; x++) {
          if (*defined.at(x, y)) continue;
          const NearestDirections::Texel got = nearest.nearest(x);
          const std::uint32_t source = sources[std::size_t(y) * w + x];
          ASSERT_EQ(got.t, t[source]) << w << "x" << h << ", " << filled << ": column " << x << ", row " << y;
          ASSERT_EQ(got.n, n[source]);
        }
      }
    }
  EXPECT_EQ(dir.entries(), 0u);
}

// Bands of so narrow a map are of 4096 rows.
TEST(Orthonormalise, HolesMayReachFromBandToBand) {
  const int w = 3, h = 13000;
  Random random(17);
  DirectionMap map = map_of(w, h, random.directions(w * h));
  const std::vector<Vec3f> before = map.vectors;
  ByteImage defined(w, h);
  for (int i = 0; i < w * h; i++) {
    const int y = i / w;
    const bool hole = (y > 5000 && y < 12500 && !(y == 9000 && i % w == 1)) || random.below(1000) == 0;
    defined.data[i] = !hole;
    if (hole) map.vectors[i] = {};
  }
  const std::vector<std::uint32_t> sources = gutter_sources(defined, w + h);
  EXPECT_EQ(orthonormalise(map, nullptr, false), std::size_t(std::ranges::count(defined.data, 0)));
  for (int i = 0; i < w * h; i++)
    ASSERT_LT(length(map.vectors[i] - before[sources[i]]), 1e-6) << "column " << i % w << ", row " << i / w;
}

TEST(Orthonormalise, TakesAwayWhatLiesAlongTheNormal) {
  Random random(3);
  const int w = 40, h = 30;
  SurfaceNormals normals{w, h, random.directions(w * h), 0, 0};
  const std::vector<Vec3f> before = random.directions(w * h);
  DirectionMap map = map_of(w, h, before);
  for (Vec3f& v : map.vectors) v = v * float(std::exp(20 * random.unit() - 10));
  EXPECT_EQ(orthonormalise(map, &normals, false), 0u);
  for (std::size_t i = 0; i < before.size(); i++) {
    const Vec3d n(normals.vectors[i]), t(before[i]);
    ASSERT_NEAR(dot(n, Vec3d(map.vectors[i])), 0, 2e-7);
    ASSERT_NEAR(length(Vec3d(map.vectors[i])), 1, 1e-7);
    const Vec3d expected = normalized(t - n * dot(n, t));
    if (length(cross(n, t)) > 0.01) {
      ASSERT_LT(length(expected - Vec3d(map.vectors[i])), 1e-4);
    }
  }
  // With no normals only the length changes, and the plane of the map takes z away.
  map = map_of(1, 1, {{3, 0, -4}});
  orthonormalise(map, nullptr, false);
  expect_near(map.vectors[0], {0.6f, 0, -0.8f}, 1e-7, "as read");
  orthonormalise(map, nullptr, true);
  EXPECT_EQ(map.vectors[0], (Vec3f{1, 0, 0}));
}

TEST(Orthonormalise, WhatIsNotDefinedTakesItsNearestNeighbour) {
  // Undefined: no length, along its normal, against it.
  const Vec3f up{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0};
  DirectionMap map = map_of(6, 1, {{5, 0, 0}, {0, 0, 0}, up, up * -3.f, u, v * 2.f});
  SurfaceNormals flat{6, 1, std::vector<Vec3f>(6, up), 0, 0};
  EXPECT_EQ(orthonormalise(map, &flat, false), 3u);
  EXPECT_EQ(map.vectors, (std::vector<Vec3f>{u, u, u, u, u, v}));
  // The neighbour's direction, made orthogonal to the texel's own normal.
  map = map_of(2, 1, {u, {0, 0, 0}});
  flat = {2, 1, {up, {0.6f, 0, 0.8f}}, 0, 0};
  EXPECT_EQ(orthonormalise(map, &flat, false), 1u);
  expect_near(map.vectors[1], {0.8f, 0, -0.6f}, 1e-7, "tilted");
  // The neighbour's direction is the texel's own normal: it goes on round the edge between them.
  for (const float side : {1.f, -1.f}) {
    map = map_of(2, 1, {u, {0, 0, 0}});
    flat = {2, 1, {up, u * side}, 0, 0};
    EXPECT_EQ(orthonormalise(map, &flat, false), 1u);
    expect_near(map.vectors[1], {0, 0, -side}, 1e-7, "round the edge");
  }
  // In the plane of the map: what stands upright has no direction there.
  map = map_of(2, 1, {v, up});
  EXPECT_EQ(orthonormalise(map, nullptr, true), 1u);
  EXPECT_EQ(map.vectors[1], v);
  flat = {2, 1, {up, v}, 0, 0};
  map = map_of(2, 1, {v, up});
  EXPECT_EQ(orthonormalise(map, &flat, true), 1u);
  EXPECT_EQ(map.vectors[1], v);
}

TEST(Orthonormalise, WhereNothingIsDefinedThereIsAnError) {
  const Vec3f up{0, 0, 1};
  DirectionMap map = map_of(2, 1, {{0, 0, 0}, {0, 0, 0}});
  EXPECT_ERROR(orthonormalise(map, nullptr, false), ErrorKind::kMalformed, "'map': expected directions, got none");
  map = map_of(2, 1, {up, up});
  const SurfaceNormals flat{2, 1, {up, up}, 0, 0};
  EXPECT_ERROR(orthonormalise(map, &flat, false), ErrorKind::kMalformed, "parallel to its normal");
  EXPECT_ERROR(orthonormalise(map, nullptr, true), ErrorKind::kMalformed, "expected directions, got none");
}

// 0 stores as 128, or 127, of 255: neither is a direction, nor is what a flat normal leaves of (0,0,1).
TEST(Orthonormalise, SamplesThatCannotHoldZero) {
  const ScratchDir dir;
  for (const float half : {127 / 255.f, 128 / 255.f})
    for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16}) {
      const float zero = sample == SampleType::kUint8 ? half : std::round(half * 65535) / 65535;
      if (sample == SampleType::kUint16 && std::abs(zero - 0.5f) > 1e-4f) continue;
      write_samples(dir / "t.png", sample, 3, 1, 3, {1, zero, zero, zero, zero, zero, zero, zero, 1});
      write_samples(dir / "n.png", sample, 3, 1, 3, {zero, zero, 1, zero, zero, 1, zero, zero, 1});
      DirectionMap map = read_direction_map(dir / "t.png", {});
      const SurfaceNormals normals = read_surface_normals(dir / "n.png", {});
      EXPECT_EQ(orthonormalise(map, &normals, false), 2u) << name(sample) << " " << zero;
      expect_near(map.vectors[1], {1, 0, 0}, 0.01, "a hole");
      // Floats hold 0, and a normal in integers is flat as far as it can be.
      write_samples(dir / "t.exr", SampleType::kFloat, 3, 1, 3, {1e-20f, 0, 0, 0, 0, 0, 0, 0, 1});
      map = read_direction_map(dir / "t.exr", {});
      EXPECT_EQ(orthonormalise(map, &normals, false), 2u);
      map = read_direction_map(dir / "t.png", {kFlow});
      EXPECT_EQ(orthonormalise(map, nullptr, false), 2u);
    }
  // One step further is a direction.
  write_samples(dir / "t.png", SampleType::kUint8, 1, 1, 3, {129 / 255.f, 128 / 255.f, 128 / 255.f});
  DirectionMap map = read_direction_map(dir / "t.png", {});
  EXPECT_EQ(orthonormalise(map, nullptr, false), 0u);
}

struct Files {
  ScratchDir dir;
  int w = 50, h = 37;
  Files() {
    Random random(9);
    std::vector<float> flow, normals;
    for (int i = 0; i < w * h; i++) {
      const Vec3f t = random.below(20) ? random.direction() : Vec3f{}, n = random.in_cap(60);
      for (const float c : {t.x, t.y, random.below(2) ? 1.f : 0.f}) flow.push_back(c);
      for (const float c : {n.x, n.y, n.z}) normals.push_back(c);
    }
    write_samples(dir / "flow.exr", SampleType::kFloat, w, h, 3, flow);
    write_samples(dir / "n.exr", SampleType::kFloat, w, h, 3, normals);
  }
  DirectionStats convert(const DirectionTarget& to) const {
    return convert_directions({dir / "flow.exr", {kFlow}, {}, dir / "n.exr", {}}, to);
  }
};

TEST(ConvertDirections, SaysHowFarTheWrittenFileIsFromOrthogonal) {
  const Files files;
  struct Case {
    const char* file;
    SampleType sample;
    double least, most;
  };
  for (const Case& c :
       {Case{"f.exr", SampleType::kFloat, 0, 1e-6}, Case{"h.exr", SampleType::kHalf, 1e-5, 6e-4},
        Case{"t.tif", SampleType::kUint16, 1e-6, 3e-5}, Case{"b.png", SampleType::kUint8, 1e-3, 8e-3}}) {
    const DirectionStats stats = files.convert({files.dir / c.file, file_type_of(c.file), c.sample, {}});
    EXPECT_EQ(stats.width, files.w);
    EXPECT_GT(stats.degenerate_texels, 50u);
    EXPECT_LT(stats.degenerate_texels, 140u);
    EXPECT_LE(stats.max_abs_n_dot_t, c.most) << c.file;
    EXPECT_GE(stats.max_abs_n_dot_t, c.least) << c.file;
    const DirectionMap map = read_direction_map(files.dir / c.file, {});
    const SurfaceNormals normals = read_surface_normals(files.dir / "n.exr", {});
    double most = 0;
    for (std::size_t i = 0; i < map.vectors.size(); i++)
      most = std::max(most, std::abs(dot(normalized(Vec3d(map.vectors[i])), Vec3d(normals.vectors[i]))));
    EXPECT_NEAR(most, stats.max_abs_n_dot_t, 1e-7) << c.file;
  }
}

TEST(ConvertDirections, IsTheSameOnAnyNumberOfThreads) {
  const Files files;
  const auto make = [&](int threads) {
    return on_threads(threads, [&] {
      files.convert({files.dir / "x.png", FileType::kPng, SampleType::kUint16, {}});
      return bytes_of(files.dir / "x.png");
    });
  };
  EXPECT_EQ(make(1), make(4));
}

TEST(ConvertDirections, NormalsBelongToWhatIsWritten) {
  const Files files;
  DirectionSource from{files.dir / "flow.exr", {kFlow}, {false, false, 1}, files.dir / "n.exr", {}};
  const DirectionTarget to{files.dir / "x.exr", FileType::kExr, SampleType::kFloat, {}};
  EXPECT_ERROR(convert_directions(from, to), ErrorKind::kMalformed, "n.exr': expected 37x50 texels as in '");
  from.turns.quarters = 2;
  EXPECT_LT(convert_directions(from, to).max_abs_n_dot_t, 1e-6);
}

}  // namespace
}  // namespace burnish
