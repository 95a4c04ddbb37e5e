#include "burnish/ptm/files/ptm_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

PtmBytes sample(PtmType type, int width, int height) {
  PtmBytes p;
  p.type = type, p.width = width, p.height = height;
  p.scale = {0.25, 1.5, 2, 0.1, 1e-7, 3};
  p.bias = {128, -7, 0, 255, 300, 1};
  p.coefficients.resize(p.texels() * p.polynomials() * kPtmTerms);
  p.colour.resize(p.texels() * p.colours());
  for (std::size_t i = 0; i < p.coefficients.size(); i++) p.coefficients[i] = std::uint8_t(i * 37 + 11);
  for (std::size_t i = 0; i < p.colour.size(); i++) p.colour[i] = std::uint8_t(i * 53 + 7);
  return p;
}

PtmBytes read_text(const std::string& text) {
  const ScratchDir dir;
  const FileRef file = dir / "a.ptm";
  std::ofstream(file.path, std::ios::binary) << text;
  return read_ptm(file);
}

TEST(PtmFile, IsReadBackAsWritten) {
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const ScratchDir dir;
    const PtmBytes p = sample(type, 5, 3);
    write_ptm(dir / "a.ptm", p);
    const PtmBytes q = read_ptm(dir / "a.ptm");
    EXPECT_EQ(q.type, p.type);
    EXPECT_EQ(q.width, 5);
    EXPECT_EQ(q.height, 3);
    EXPECT_EQ(q.scale, p.scale);
    EXPECT_EQ(q.bias, p.bias);
    EXPECT_EQ(q.coefficients, p.coefficients);
    EXPECT_EQ(q.colour, p.colour);
  }
}

// Byte for byte what the format says, of two texels, one above the other.
TEST(PtmFile, LayoutOfLrgb) {
  const std::string head = "PTM_1.2\nPTM_FORMAT_LRGB\n1\n2\n1 1 1 1 1 1\n0 0 0 0 0 0\n";
  const PtmBytes p = read_text(head + "abcdefABCDEFxyzXYZ");
  EXPECT_EQ(std::string(p.coefficients.begin(), p.coefficients.end()), "ABCDEFabcdef");
  EXPECT_EQ(std::string(p.colour.begin(), p.colour.end()), "XYZxyz");
  const ScratchDir dir;
  write_ptm(dir / "a.ptm", p);
  std::ifstream in(dir / "a.ptm", std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), head + "abcdefABCDEFxyzXYZ");
}

TEST(PtmFile, LayoutOfRgbAndOfOlderLrgb) {
  const std::string numbers = " 1 2 1 1 1 1 1 1 0 0 0 0 0 0 \r\n";
  const PtmBytes rgb = read_text("PTM_1.2\nPTM_FORMAT_RGB\n" + numbers + "rrrrrrRRRRRRggggggGGGGGGbbbbbbBBBBBB");
  EXPECT_EQ(std::string(rgb.coefficients.begin(), rgb.coefficients.end()), "RRRRRRGGGGGGBBBBBBrrrrrrggggggbbbbbb");
  for (const char* version : {"PTM_1.0", "PTM_1.1"}) {
    const PtmBytes old = read_text(std::string(version) + "\nPTM_FORMAT_LRGB\n" + numbers + "abcdefxyzABCDEFXYZ");
    EXPECT_EQ(std::string(old.coefficients.begin(), old.coefficients.end()), "ABCDEFabcdef");
    EXPECT_EQ(std::string(old.colour.begin(), old.colour.end()), "XYZxyz");
  }
}

TEST(PtmFile, ValuesAreRawMinusBiasTimesScale) {
  PtmBytes p = sample(PtmType::kLrgb, 1, 1);
  p.coefficients = {130, 3, 4, 0, 45, 9};
  p.colour = {255, 51, 0};
  const Ptm decoded_ptm = decoded(p);
  const float expected[] = {0.5f, 15, 8, -25.5f, -255e-7f, 24};
  for (int k = 0; k < kPtmTerms; k++) EXPECT_FLOAT_EQ(decoded_ptm.coefficients[k], expected[k]) << k;
  const float light = evaluate<double>({0.5, 15, 8, -25.5, -255e-7, 24}, 0.3, -0.2);
  EXPECT_NEAR(decoded_ptm.lit(0, 0.3f, -0.2f)[0], light, 1e-5);
  EXPECT_NEAR(decoded_ptm.lit(0, 0.3f, -0.2f)[1], light / 5, 1e-5);
}

TEST(PtmFile, WhatIsNoSuchFileIsRefused) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_ERROR(read_text(text), ErrorKind::kMalformed, why);
  };
  const std::string head = "PTM_1.2\nPTM_FORMAT_LRGB\n", numbers = "1 1 1 1 1 1\n0 0 0 0 0 0\n";
  refused("", "a.ptm': expected a polynomial texture map, which begins with PTM_1.2, got ''");
  refused("\x89PNG", "expected a polynomial texture map");
  refused("PTM_2.0\n", "expected a polynomial texture map");
  refused("PTM_1.2\n", "expected a format, got the end of the file");
  refused("PTM_1.2\nRGB\n", "expected a format such as PTM_FORMAT_LRGB, got 'RGB'");
  refused(head + "0 1\n", "expected a width from 1 to 1048576, got 0");
  refused(head + "4294967297 1\n", "expected a width from 1 to 1048576");
  refused(head + "1 1.5\n", "expected a height from 1 to 1048576, got 1.5");
  refused(head + "1 1\n1 1 nan", "expected a scale, got 'nan'");
  refused(head + "1 1\n1 1e300 1 1 1 1\n0 0 0 0 0 0\n123456789",
          "expected coefficients that floats hold, got a scale or bias beyond them");
  refused(head + "1 1\n1 1 1 1 1 1\n1 2 x", "expected a bias, got 'x'");
  refused(head + "1 1\n1 1 1 1 1 1\n0 0 0 0 0 0", "expected the end of a line behind the biases");
  refused(head + "1 1\n" + numbers + "12345678", "expected 9 bytes for 1x1 texels, got 8");
  refused(head + "1048576 1048576\n" + numbers + "123456789", "bytes for 1048576x1048576 texels, got 9");
  for (const char* format : {"LUM", "PTM_LUT", "PTM_C_LUT", "JPEGLS_RGB"})
    EXPECT_ERROR(read_text(std::string("PTM_1.2\nPTM_FORMAT_") + format + "\n1\n1\n"), ErrorKind::kUnsupported,
                 std::string("got PTM_FORMAT_") + format);
  EXPECT_ERROR(read_ptm("nothing.ptm"), ErrorKind::kIo, "'nothing.ptm'");
}

}  // namespace
}  // namespace burnish
