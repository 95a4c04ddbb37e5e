// Files of floats and of textures; and .ptm files whose bytes are damaged.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "burnish/core/error.h"
#include "burnish/ptm/files/open_ptm.h"
#include "burnish/ptm/files/ptm_exr.h"
#include "burnish/ptm/files/ptm_file.h"
#include "burnish/ptm/files/ptm_textures.h"
#include "burnish/ptm/light_matrix.h"
#include "damaged.h"
#include "expect_error.h"
#include "ptm_map_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::made_up_bytes;
using testing::made_up_map;
using testing::ScratchDir;
using testing::write_bytes;

Ptm all_of(const PtmRows& rows) {
  Ptm map{rows.shape(), {}, {}};
  map.coefficients.resize(map.texels() * map.polynomials() * kPtmTerms);
  map.colour.resize(map.texels() * map.colours());
  rows.read(0, map.height, map.coefficients.data(), map.colour.data());
  return map;
}

TEST(PtmExr, IsReadBackAsWritten) {
  const ScratchDir dir;
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const Ptm map = made_up_map(type, 37, 41);
    write_ptm_exr(dir / "a.exr", PtmInMemory(map));
    const OpenPtm open = open_ptm(dir / "a.exr");
    EXPECT_EQ(open.format, "EXR");
    EXPECT_EQ(open.rows->shape().type, type);
    const Ptm back = all_of(*open.rows);
    EXPECT_EQ(back.coefficients, map.coefficients);
    EXPECT_EQ(back.colour, map.colour);
    std::vector<float> row(37 * map.polynomials() * 6), colour(37 * map.colours());
    open.rows->read(20, 1, row.data(), colour.data());
    EXPECT_TRUE(std::equal(row.begin(), row.end(), map.coefficients.begin() + 20 * row.size()));
  }
}

TEST(PtmExr, ChannelsAndAttributeAreThoseOfTheFormat) {
  const ScratchDir dir;
  write_ptm_exr(dir / "a.exr", PtmInMemory(made_up_map(PtmType::kLrgb, 5, 3)));
  ImageReader lrgb(dir / "a.exr");
  std::vector<std::string> names = lrgb.channel_names();
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"B", "G", "R", "a0", "a1", "a2", "a3", "a4", "a5"}));
  EXPECT_EQ(lrgb.text("burnish:ptm"), "lrgb");
  EXPECT_EQ(lrgb.sample_type(), SampleType::kFloat);
  write_ptm_exr(dir / "b.exr", PtmInMemory(made_up_map(PtmType::kRgb, 5, 3)));
  ImageReader rgb(dir / "b.exr");
  EXPECT_EQ(rgb.text("burnish:ptm"), "rgb");
  EXPECT_EQ(rgb.channels(), 18);
  for (const char* name : {"R.a0", "G.a3", "B.a5"}) EXPECT_EQ(std::ranges::count(rgb.channel_names(), name), 1) << name;
}

TEST(PtmExr, WhatIsNoMapIsRefused) {
  const ScratchDir dir;
  const auto write = [&](const Attributes& attributes) {
    write_image(dir / "a.exr", FileType::kExr, SampleType::kFloat, Image(2, 2, 3), attributes);
  };
  write({});
  EXPECT_ERROR(open_ptm(dir / "a.exr"), ErrorKind::kMalformed, "a.exr': expected a polynomial texture map, whose");
  write({{"burnish:ptm", "lum"}});
  EXPECT_ERROR(open_ptm(dir / "a.exr"), ErrorKind::kMalformed, "got 'lum'");
  write({{"burnish:ptm", "rgb"}});
  EXPECT_ERROR(open_ptm(dir / "a.exr"), ErrorKind::kMalformed, "expected a channel R.a0, got none");
  Ptm map = made_up_map(PtmType::kLrgb, 4, 3);
  map.coefficients[6 * 6 + 2] = NAN;
  write_ptm_exr(dir / "a.exr", PtmInMemory(map));
  EXPECT_ERROR(all_of(*open_ptm(dir / "a.exr").rows), ErrorKind::kMalformed,
               "expected finite coefficients, got nan at column 2, row 1");
  map = made_up_map(PtmType::kLrgb, 4, 3);
  map.colour[4] = 256;
  write_ptm_exr(dir / "a.exr", PtmInMemory(map));
  EXPECT_ERROR(all_of(*open_ptm(dir / "a.exr").rows), ErrorKind::kMalformed,
               "expected colours from 0 to 255, got 256 at column 1, row 0");
}

PtmTextureFiles textures_in(const ScratchDir& dir) {
  PtmTextureFiles files;
  const auto names = ptm_texture_names();
  for (std::size_t i = 0; i < files.images.size(); i++) files.images[i] = dir / names[i];
  files.json = dir / names.back();
  return files;
}

TEST(PtmTextures, HoldTheBytesOfAnRgbMap) {
  const ScratchDir dir;
  const PtmBytes map = made_up_bytes(PtmType::kRgb, 7, 5);
  write_ptm_textures(textures_in(dir), PtmInBytes(map), uniform_normal_matrix(), {{"source", "ward:ax=0.2"}});
  EXPECT_EQ(dir.entries(), 7u);
  const PtmTextures back = read_ptm_textures(textures_in(dir));
  ASSERT_TRUE(back.rows->bytes());
  EXPECT_EQ(back.rows->bytes()->coefficients, map.coefficients);
  EXPECT_EQ(back.rows->bytes()->scale, map.scale);
  EXPECT_EQ(back.rows->bytes()->bias, map.bias);
  EXPECT_EQ(back.made_of, PtmType::kRgb);
  EXPECT_NE(back.description.text.find("\"source\": \"ward:ax=0.2\""), std::string::npos);
  // Green's a₄, in the middle of the last image of green.
  const Image def_green = read_image(dir / "def_green.png");
  EXPECT_NEAR(def_green.at(3, 2)[1] * 255, map.coefficients[((2 * 7 + 3) * 3 + 1) * 6 + 4], 1e-3);
}

TEST(PtmTextures, OfAnLrgbMapHaveItsColourInThem) {
  const ScratchDir dir;
  const Ptm map = made_up_map(PtmType::kLrgb, 16, 12);
  write_ptm_textures(textures_in(dir), PtmInMemory(map), uniform_normal_matrix());
  const PtmTextures back = read_ptm_textures(textures_in(dir));
  EXPECT_EQ(back.made_of, PtmType::kLrgb);
  const Ptm rgb = all_of(*back.rows);
  for (std::size_t i = 0; i < map.texels(); i++)
    for (int c = 0; c < 3; c++) EXPECT_NEAR(rgb.lit(i, -0.4f, 0.3f)[c], map.lit(i, -0.4f, 0.3f)[c], 0.5) << i;
}

// Whatever the bytes are, they give a map or one burnish::Error, and memory only for what they hold.
class PtmDamage : public ::testing::TestWithParam<std::string> {
 protected:
  std::string sample() const {
    const std::string& kind = GetParam();
    const bool is_jpeg = kind.starts_with("jpeg");
    const PtmBytes map = made_up_bytes(kind.ends_with("lrgb") ? PtmType::kLrgb : PtmType::kRgb, 9, 6);
    write_ptm(dir_ / "whole.ptm", map, is_jpeg ? 80 : 0);
    return bytes_of(dir_ / "whole.ptm");
  }

  bool reads(const std::string& bytes, const std::string& what) const {
    write_bytes(dir_ / "a.ptm", bytes);
    try {
      const PtmFile map = read_ptm({dir_ / "a.ptm", "a.ptm"});
      EXPECT_GE(bytes.size() * 512 * 18, map.coefficients.size()) << what;
      EXPECT_EQ(map.coefficients.size(), map.texels() * map.polynomials() * 6) << what;
      EXPECT_EQ(map.colour.size(), map.texels() * map.colours()) << what;
      return true;
    } catch (const Error& e) {
      const std::string message = e.what();
      EXPECT_TRUE(e.kind() == ErrorKind::kMalformed || e.kind() == ErrorKind::kUnsupported) << what << ": " << message;
      EXPECT_EQ(message.find("'a.ptm': "), 0u) << what << ": " << message;
      EXPECT_NE(message.find("expected "), message.npos) << what << ": " << message;
      EXPECT_NE(message.find(", got "), message.npos) << what << ": " << message;
      EXPECT_TRUE(std::ranges::none_of(message, [](char c) { return c >= 0 && c < ' '; })) << what;
      return false;
    }
  }

  ScratchDir dir_;
};

TEST_P(PtmDamage, NoPrefixReadsAsAWholeFile) {
  const std::string bytes = sample();
  for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 17)
    EXPECT_FALSE(reads(bytes.substr(0, size), "the first " + std::to_string(size) + " bytes"));
  EXPECT_TRUE(reads(bytes, "all"));
}

TEST_P(PtmDamage, MutationsReadSoundlyOrNotAtAll) {
  const std::string bytes = sample(), likely = std::string("0123456789-+.eE \n\rRGBL_\xff\xd8\xd9\x80") + '\0';
  const std::size_t head = std::min<std::size_t>(bytes.size(), 330);
  std::mt19937 random(1);
  for (int i = 0; i < 2000; i++) {
    reads(testing::damaged(bytes, head, likely, i, random), "mutation " + std::to_string(i));
    if (HasFailure()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PtmDamage, ::testing::Values("lrgb", "rgb", "jpeg_lrgb", "jpeg_rgb"),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace burnish
