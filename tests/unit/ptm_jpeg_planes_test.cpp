#include <gtest/gtest.h>

#include <sstream>

#include "burnish/core/image_io.h"
#include "burnish/ptm/files/grey_jpeg.h"
#include "burnish/ptm/files/ptm_file.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/round_ptm.h"
#include "expect_error.h"
#include "ptm_map_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::dome_of_lights;
using testing::made_up_map;
using testing::ScratchDir;
using testing::write_bytes;

// A plane of one value, which a JPEG holds exactly.
std::string plain(int value, int width = 3, int height = 2) {
  return encode_grey_jpeg(width, height, 1, [&](int, std::uint8_t* row) { std::fill_n(row, width, value); });
}

std::string line(const std::vector<long>& values) {
  std::string text;
  for (const long v : values) text += std::to_string(v) + " ";
  return text + "\n";
}

// A JPEG_LRGB file of 3x2 texels, by its parts: plane i is 10 · i + 20.
struct Parts {
  std::string head = "PTM_1.2\nPTM_FORMAT_JPEG_LRGB\n3\n2\n1 1 1 1 1 1\n0 0 0 0 0 0\n";
  std::vector<long> transforms = std::vector<long>(9), x = transforms, y = transforms, order{0, 1, 2, 3, 4, 5, 6, 7, 8},
                    reference = std::vector<long>(9, -1);
  std::vector<std::string> streams, sides = std::vector<std::string>(9);

  Parts() {
    for (int i = 0; i < 9; i++) streams.push_back(plain(10 * i + 20));
  }
  std::string text() const {
    std::vector<long> sizes, side_sizes;
    std::string body;
    for (int i = 0; i < 9; i++) {
      sizes.push_back(long(streams[i].size())), side_sizes.push_back(long(sides[i].size()));
      body += streams[i] + sides[i];
    }
    return head + "90\n" + line(transforms) + line(x) + line(y) + line(order) + line(reference) + line(sizes) +
           line(side_sizes) + body;
  }
  PtmFile read() const {
    const ScratchDir dir;
    write_bytes(dir / "a.ptm", text());
    return read_ptm(dir / "a.ptm");
  }
  void refused(const std::string& why, ErrorKind kind = ErrorKind::kMalformed) const {
    EXPECT_ERROR(read(), kind, why);
  }
};

std::vector<int> first_texel(const PtmBytes& map) {
  std::vector<int> values(map.coefficients.begin(), map.coefficients.begin() + 6);
  values.insert(values.end(), map.colour.begin(), map.colour.begin() + 3);
  return values;
}

TEST(PtmJpegPlanes, AreReadAsTheyStand) {
  const PtmFile map = Parts().read();
  EXPECT_EQ(map.format, "PTM_1.2 JPEG_LRGB");
  EXPECT_EQ(first_texel(map), (std::vector<int>{20, 30, 40, 50, 60, 70, 80, 90, 100}));
}

TEST(PtmJpegPlanes, ReferencesAndInversion) {
  Parts parts;
  parts.reference = {-1, 0, 1, 0, -1, 4, -1, 6, 7};
  parts.transforms = {0, 0, 1, 1, 1, 0, 0, 0, 0};  // of plane 4 it means nothing
  // 1: 30 + 20 − 128 = 178 modulo 256; 2: 40 + (255 − 178) − 128 = 245; 3: 50 + (255 − 20) − 128 = 157;
  // 5: 70 + 60 − 128 = 2; 7: 90 + 80 − 128 = 42; 8: 100 + 42 − 128 = 14
  EXPECT_EQ(first_texel(parts.read()), (std::vector<int>{20, 178, 245, 157, 60, 2, 80, 42, 14}));
}

TEST(PtmJpegPlanes, AreTakenInTheirOrder) {
  Parts parts;
  parts.reference = {1, 2, -1, -1, -1, -1, -1, -1, -1};
  parts.order = {2, 1, 0, 3, 4, 5, 6, 8, 7};  // 2, then 1, then 0
  // 1: 30 + 40 − 128 = 198; 0: 20 + 198 − 128 = 90
  EXPECT_EQ(first_texel(parts.read()), (std::vector<int>{90, 198, 40, 50, 60, 70, 80, 90, 100}));
}

TEST(PtmJpegPlanes, SideInformationReplacesTexelsBeforeOthersReferToThem) {
  Parts parts;
  using namespace std::string_literals;
  // Texel 4 is the middle of the second row from the bottom: of two rows, the top one.
  parts.sides[0] = "\0\0\0\4\x81"s + "\0\0\0\0\7"s;
  parts.reference[1] = 0;
  const PtmFile map = parts.read();
  const auto value = [&](int column, int row, int plane) { return map.coefficients[(row * 3 + column) * 6 + plane]; };
  EXPECT_EQ(value(1, 0, 0), 0x81);
  EXPECT_EQ(value(0, 1, 0), 7);
  EXPECT_EQ(value(0, 0, 0), 20);
  EXPECT_EQ(value(1, 0, 1), 30 + 0x81 - 128);
  EXPECT_EQ(value(0, 0, 1), 178);
}

TEST(PtmJpegPlanes, MotionIsRefusedWhereItWouldMatter) {
  Parts parts;
  parts.transforms[3] = 2;
  parts.x[3] = 5;
  EXPECT_EQ(first_texel(parts.read())[3], 50);  // no reference to move
  parts.reference[3] = 0;
  parts.refused("plane 3: expected a reference plane in place, got motion compensation", ErrorKind::kUnsupported);
  parts.x[3] = 0;
  EXPECT_EQ(first_texel(parts.read())[3], 50 + 20 - 128 + 256);
}

TEST(PtmJpegPlanes, WhatContradictsItselfIsRefused) {
  const auto with = [](auto change) {
    Parts parts;
    change(parts);
    return parts;
  };
  with([](Parts& p) {
    p.order[3] = 2;
  }).refused("a.ptm': expected each plane to have its own place in the order, got 2");
  with([](Parts& p) { p.order[3] = 9; }).refused("expected a plane's order from 0 to 8, got 9");
  with([](Parts& p) { p.transforms[0] = 4; }).refused("expected a plane's transforms from 0 to 3, got 4");
  with([](Parts& p) {
    p.reference[2] = 2;
  }).refused("expected plane 2 to refer to one before it in the order, got plane 2");
  with([](Parts& p) { p.reference[2] = 5, p.reference[5] = 2; }).refused("expected plane 2 to refer to one before it");
  with([](Parts& p) { p.reference[2] = -2; }).refused("expected a reference plane from -1 to 8, got -2");
  with([](Parts& p) {
    p.sides[1] = "1234";
  }).refused("plane 1: expected side information in records of 5 bytes, got 4");
  with([](Parts& p) {
    p.sides[1] = std::string("\0\0\0\6x", 5);
  }).refused("plane 1: expected side information of 3x2 texels, got offset 6");
  with([](Parts& p) { p.streams[8].resize(20); }).refused("plane 8: ");
  with([](Parts& p) { p.streams[2].resize(p.streams[2].size() - 20); }).refused("plane 2: ");
  with([](Parts& p) { p.streams[2][0] = 'x'; }).refused("plane 2: ");
  with([](Parts& p) { p.streams[4] = plain(9, 2, 3); }).refused("plane 4: expected a JPEG of 3x2 texels, got 2x3");
  with([](Parts& p) {
    p.head.replace(p.head.find("3\n2\n"), 4, "32768\n32768\n");
  }).refused("plane 0: expected a JPEG of 32768x32768 texels, got ");
  with([](Parts& p) {
    p.head.replace(p.head.find("3\n2\n"), 4, "300\n20\n");
  }).refused("plane 0: expected a JPEG of 300x20 texels, got 3x2");
  Parts parts;
  std::string text = parts.text();
  const ScratchDir dir;
  for (const std::size_t size : {text.size() - 1, text.size() / 2, parts.head.size(), parts.head.size() + 5}) {
    write_bytes(dir / "cut.ptm", text.substr(0, size));
    EXPECT_ERROR(read_ptm(dir / "cut.ptm"), ErrorKind::kMalformed, "cut.ptm'");
  }
}

// What is written, read by the text and another decoder of JPEG.
TEST(PtmJpegPlanes, AreWrittenAsTheFormatSays) {
  const ScratchDir dir;
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const PtmBytes map = rounded(PtmInMemory(made_up_map(type, 21, 13)), uniform_normal_matrix());
    write_ptm(dir / "a.ptm", map, 90);
    const PtmFile back = read_ptm(dir / "a.ptm");
    std::istringstream in(bytes_of(dir / "a.ptm"));
    std::string text;
    const std::size_t n = type == PtmType::kLrgb ? 9 : 18;
    std::getline(in, text);
    EXPECT_EQ(text, "PTM_1.2");
    std::getline(in, text);
    EXPECT_EQ(text, type == PtmType::kLrgb ? "PTM_FORMAT_JPEG_LRGB" : "PTM_FORMAT_JPEG_RGB");
    std::getline(in, text);
    EXPECT_EQ(text, "21");
    std::getline(in, text);
    EXPECT_EQ(text, "13");
    std::getline(in, text), std::getline(in, text);  // scales, biases
    std::getline(in, text);
    EXPECT_EQ(text, "90");
    std::vector<std::vector<long>> lines(7);
    for (auto& values : lines) {
      std::getline(in, text);
      std::istringstream numbers(text);
      for (long v; numbers >> v;) values.push_back(v);
      EXPECT_EQ(values.size(), n);
    }
    for (std::size_t i = 0; i < n; i++) {
      EXPECT_EQ(lines[0][i], 0);
      EXPECT_EQ(lines[1][i], 0);
      EXPECT_EQ(lines[2][i], 0);
      EXPECT_EQ(lines[6][i], 0);
      EXPECT_EQ(lines[3][i], long(i));
      EXPECT_EQ(lines[4][i], -1);
      std::string stream(std::size_t(lines[5][i]), 0);
      in.read(stream.data(), lines[5][i]);
      write_bytes(dir / "plane.jpg", stream);
      const Image plane = read_image(dir / "plane.jpg");
      ASSERT_EQ(plane.width, 21);
      ASSERT_EQ(plane.height, 13);
      ASSERT_EQ(plane.channels, 1);
      for (int y = 0; y < 13; y++)
        for (int x = 0; x < 21; x++) {
          const std::size_t texel = std::size_t(12 - y) * 21 + x;
          const int got = i < std::size_t(back.polynomials()) * 6
                              ? back.coefficients[texel * back.polynomials() * 6 + i]
                              : back.colour[texel * 3 + i - 6];
          EXPECT_NEAR(plane.at(x, y)[0] * 255, got, 1e-3);
        }
    }
    EXPECT_EQ(in.get(), EOF);
  }
}

// Of photographs rounded to 8 bits: what raw bytes and what planes of quality 95 show.
TEST(PtmJpegPlanes, OfQuality95AreWithinADecibelOfRawBytes) {
  const ScratchDir dir;
  const std::vector<Vec3d> lights = dome_of_lights(40);
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const Ptm map = made_up_map(type, 96, 64);
    const auto squared_error = [&](const PtmBytes& bytes) {
      const Ptm shown = decoded(bytes);
      double sum = 0;
      for (const Vec3d& l : lights)
        for (std::size_t i = 0; i < map.texels(); i++)
          for (int c = 0; c < 3; c++) {
            const double photo = std::round(map.lit(i, float(l.x), float(l.y))[c]);
            sum += std::pow(shown.lit(i, float(l.x), float(l.y))[c] - photo, 2);
          }
      return sum;
    };
    const PtmBytes raw = rounded(PtmInMemory(map), light_matrix(lights, 0, "dome").normal);
    write_ptm(dir / "a.ptm", raw, 95);
    const double worse_db = 10 * std::log10(squared_error(read_ptm(dir / "a.ptm")) / squared_error(raw));
    EXPECT_LT(worse_db, 1) << name(type);
    EXPECT_LT(bytes_of(dir / "a.ptm").size(), raw.texels() * (type == PtmType::kLrgb ? 9 : 18) * 3 / 4);
  }
}

TEST(PtmJpegPlanes, ScalesOfNoughtAndBlackColoursDoNoHarm) {
  const ScratchDir dir;
  PtmBytes map = rounded(PtmInMemory(made_up_map(PtmType::kLrgb, 16, 8)), uniform_normal_matrix());
  map.scale = {0, 1, 0, 1, 0, 1};
  std::ranges::fill(map.colour, std::uint8_t(0));
  write_ptm(dir / "a.ptm", map, 95);
  const PtmFile back = read_ptm(dir / "a.ptm");
  EXPECT_EQ(back.colour, map.colour);
  EXPECT_EQ(back.scale, map.scale);
}

}  // namespace
}  // namespace burnish
