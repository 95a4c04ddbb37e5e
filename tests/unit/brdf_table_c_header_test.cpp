// Lookup tables as C headers: their numbers, read back, are the table's. That compilers take them is tested in
// cli/lut.bats.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "burnish/brdf/tables/table_c_header.h"
#include "burnish/brdf/tables/table_error.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;
using testing::ScratchDir;

TableFile table(LookupKind kind, int width, int height) {
  LookupFunction f;
  f.kind = kind;
  f.domain = default_domain(kind);
  return {f, bake_table(f, width, height, TableSampling::kEdge, TableLayout::kPlain)};
}

// What stands between the braces of the array; suffixes such as f are passed over.
std::vector<double> numbers_in(const std::string& header) {
  const std::size_t first = header.find("] = {") + 5;
  std::istringstream in(header.substr(first, header.find("};", first) - first));
  std::vector<double> numbers;
  for (std::string word; std::getline(in, word, ',');)
    if (word.find_first_not_of(" \n") != std::string::npos) numbers.push_back(std::stod(word));
  return numbers;
}

// IEEE 754 binary16; infinity and NaN aside.
double half_from_bits(int bits) {
  const int exponent = bits >> 10, mantissa = bits & 1023;
  return exponent ? std::ldexp(1024 + mantissa, exponent - 25) : std::ldexp(mantissa, -24);
}

TEST(BrdfTableCHeader, ItsNumbersAreTheTables) {
  const ScratchDir dir;
  for (const LookupKind kind : {LookupKind::kBanksR, LookupKind::kWardS, LookupKind::kWardE, LookupKind::kStrand})
    for (const SampleType sample : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat}) {
      const TableFile t = table(kind, 37, kind == LookupKind::kWardE || kind == LookupKind::kStrand ? 5 : 1);
      write_table_header(dir / "t.h", sample, t);
      const std::vector<double> numbers = numbers_in(bytes_of(dir / "t.h"));
      const std::vector<float> values = t.table.texels.data, stored = as_stored(t.table, sample).texels.data;
      ASSERT_EQ(numbers.size(), values.size());
      const double scale = table_scale(t.table), most = sample == SampleType::kUint8 ? 255 : 65535;
      for (std::size_t i = 0; i < values.size(); i++) {
        SCOPED_TRACE(std::string(name(kind)) + " " + name(sample) + " " + std::to_string(i));
        if (sample == SampleType::kFloat) EXPECT_EQ(float(numbers[i]), values[i]);
        else if (sample == SampleType::kHalf) EXPECT_EQ(half_from_bits(int(numbers[i])), stored[i]);
        else EXPECT_NEAR(numbers[i], values[i] / scale * most, 0.505);
      }
    }
}

TEST(BrdfTableCHeader, LooksLikeThis) {
  const ScratchDir dir;
  TableFile t = table(LookupKind::kWardE, 2, 3);
  t.table.texels.data = {0, 1, 0.5f, 1e-5f, 0.1f, 100};
  write_table_header(dir / "t.h", SampleType::kFloat, t);
  EXPECT_EQ(bytes_of(dir / "t.h"), R"(/* Lookup table; columns run over the first argument, rows over the second.
   function: ward-e
   domain: 0:16,0:1
   sampling: edge
   layout: plain
   parameters: {}
   samples: float */
#ifndef BURNISH_WARD_E_H
#define BURNISH_WARD_E_H

#include <stdint.h>

enum { burnish_ward_e_width = 2, burnish_ward_e_height = 3, burnish_ward_e_channels = 1 };

static const float burnish_ward_e[3 * 2 * 1] = {
0.0f, 1.0f,
0.5f, 1e-05f,
0.1f, 100.0f,
};

#endif
)");
  write_table_header(dir / "t.h", SampleType::kUint8, t);
  EXPECT_NE(bytes_of(dir / "t.h").find("samples: uint8, value = sample / 255 * 100 */"), std::string::npos);
  EXPECT_NE(bytes_of(dir / "t.h").find("static const uint8_t burnish_ward_e"), std::string::npos);
  write_table_header(dir / "t.h", SampleType::kHalf, t);
  EXPECT_NE(bytes_of(dir / "t.h").find("samples: half, its bits */"), std::string::npos);
  EXPECT_NE(bytes_of(dir / "t.h").find("static const uint16_t burnish_ward_e"), std::string::npos);
}

TEST(BrdfTableCHeader, NoLineIsWiderThan120) {
  const ScratchDir dir;
  write_table_header(dir / "t.h", SampleType::kFloat, table(LookupKind::kStrand, 100, 2));
  std::istringstream in(bytes_of(dir / "t.h"));
  std::size_t widest = 0;
  for (std::string line; std::getline(in, line);) widest = std::max(widest, line.size());
  EXPECT_LE(widest, 120u);
  EXPECT_GT(widest, 100u);
}

TEST(BrdfTableCHeader, WhatCannotBeHeldOrWrittenIsRefused) {
  const ScratchDir dir;
  TableFile t = table(LookupKind::kWardS, 8, 1);
  t.table.texels.data[0] = 1e5f;
  EXPECT_ERROR(write_table_header(dir / "t.h", SampleType::kHalf, t), ErrorKind::kUnsupported,
               "format: expected values within 65504, which half holds, got 1e+05");
  EXPECT_EQ(dir.entries(), 0u);
  EXPECT_ERROR(write_table_header(dir / "none/t.h", SampleType::kFloat, t), ErrorKind::kIo, "none/t.h'");
}

}  // namespace
}  // namespace burnish
