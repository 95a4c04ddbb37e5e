// Lookup tables in files: what was written is read back, and what is no table, or contradicts itself, is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burnish/brdf/tables/table_error.h"
#include "burnish/brdf/tables/table_file.h"
#include "burnish/core/image_io.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;
using Numbers = std::vector<double>;

constexpr LookupKind kAll[]{LookupKind::kBanksR, LookupKind::kBlinnPhongF, LookupKind::kWardS,
                            LookupKind::kWardE,  LookupKind::kStrand,      LookupKind::kLightFactor};

// With parameters of its own, and ends that single precision holds.
LookupFunction function(LookupKind kind) {
  LookupFunction f;
  f.kind = kind;
  f.domain = default_domain(kind);
  if (kind == LookupKind::kWardS) f.domain = {{0.0625, 1}};
  f.approximate = kind == LookupKind::kBanksR;
  if (kind == LookupKind::kStrand) f.exponent = 0.1;
  if (kind == LookupKind::kLightFactor) f.light = {2.7, 0.1, 0}, f.ambient = 0.3, f.transition = 0.7;
  return f;
}

TableFile table(LookupKind kind, TableSampling sampling = TableSampling::kEdge,
                TableLayout layout = TableLayout::kPlain) {
  const LookupFunction f = function(kind);
  return {f, bake_table(f, 6, f.arguments() > 1 ? 4 : 1, sampling, layout)};
}

const std::pair<const char*, SampleType> kFiles[]{{"t.exr", SampleType::kHalf},  {"t.exr", SampleType::kFloat},
                                                  {"t.png", SampleType::kUint8}, {"t.png", SampleType::kUint16},
                                                  {"t.tif", SampleType::kUint8}, {"t.tif", SampleType::kUint16},
                                                  {"t.tif", SampleType::kFloat}};

void expect_same(const LookupFunction& a, const LookupFunction& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.domain, b.domain);
  EXPECT_EQ(a.approximate, b.approximate);
  EXPECT_EQ(a.exponent, b.exponent);
  EXPECT_TRUE(a.light.x == b.light.x && a.light.y == b.light.y && a.light.z == b.light.z);
  EXPECT_EQ(a.ambient, b.ambient);
  EXPECT_EQ(a.transition, b.transition);
}

TEST(BrdfTableFile, WhatIsWrittenIsReadBack) {
  const ScratchDir dir;
  using enum TableLayout;
  for (const LookupKind kind : kAll)
    for (const auto& [sampling, layout] : {std::pair{TableSampling::kEdge, kPlain},
                                           {TableSampling::kCentre, kPlain},
                                           {TableSampling::kCentre, kOffsetHalf},
                                           {TableSampling::kCentre, kCubeZ}})
      for (const auto& [file, sample] : kFiles) {
        if (layout != kPlain && function(kind).domain[0] != Range{-1, 1}) continue;
        SCOPED_TRACE(std::string(name(kind)) + " " + name(layout) + " " + file + " " + name(sample));
        const TableFile written = table(kind, sampling, layout);
        write_table(dir / file, file_type_of(file), sample, written);
        const TableFile read = read_table(dir / file);
        expect_same(read.function, written.function);
        EXPECT_EQ(read.table.domain, written.table.domain);
        EXPECT_EQ(read.table.sampling, sampling);
        EXPECT_EQ(read.table.layout, layout);
        const LookupTable expected = as_stored(written.table, sample);
        ASSERT_EQ(read.table.texels.width, expected.texels.width);
        ASSERT_EQ(read.table.texels.height, expected.texels.height);
        ASSERT_EQ(read.table.texels.channels, expected.texels.channels);
        for (std::size_t i = 0; i < expected.texels.data.size(); i++)
          EXPECT_FLOAT_EQ(read.table.texels.data[i], expected.texels.data[i]);
      }
}

TEST(BrdfTableFile, IntegersHoldValuesOverTheMaximumRoundedHalfUp) {
  const ScratchDir dir;
  const TableFile t = table(LookupKind::kWardS);  // 4 at its singular end
  write_table(dir / "t.png", FileType::kPng, SampleType::kUint8, t);
  ImageReader reader(dir / "t.png");
  EXPECT_EQ(reader.numbers("burnish:scale"), Numbers{4});
  std::uint8_t stored[6];
  reader.read_rows_stored(0, 1, stored);
  for (int i = 0; i < 6; i++) EXPECT_EQ(stored[i], std::floor(t.table.texels.data[i] / 4 * 255 + 0.5)) << i;
  EXPECT_EQ(stored[0], 255);
  write_table(dir / "t.png", FileType::kPng, SampleType::kUint8, table(LookupKind::kLightFactor));
  const double most = float(2.7);
  EXPECT_EQ(ImageReader(dir / "t.png").numbers("burnish:scale"), (Numbers{most, most, most}));
  write_table(dir / "t.exr", FileType::kExr, SampleType::kFloat, t);
  EXPECT_EQ(ImageReader(dir / "t.exr").numbers("burnish:scale"), std::nullopt);
}

TEST(BrdfTableFile, WhatTheSamplesDoNotHoldIsRefused) {
  const ScratchDir dir;
  TableFile t = table(LookupKind::kWardS);
  t.table.texels.data[0] = 65520;
  EXPECT_ERROR(write_table(dir / "t.exr", FileType::kExr, SampleType::kHalf, t), ErrorKind::kUnsupported,
               "format: expected values within 65504, which half holds, got 65520");
  write_table(dir / "t.png", FileType::kPng, SampleType::kUint16, t);
  EXPECT_EQ(read_table(dir / "t.png").table.texels.data[0], 65520);
  t.table.texels.data[0] = HUGE_VALF;
  for (const auto& [file, sample] : kFiles)
    EXPECT_ERROR(write_table(dir / file, file_type_of(file), sample, t), ErrorKind::kUnsupported, "got inf");
}

const Attributes kStrand{{"burnish:function", "strand"},
                         {"burnish:domain", Numbers{-1, 1, -1, 1}},
                         {"burnish:sampling", "centre"},
                         {"burnish:layout", "plain"},
                         {"burnish:parameters", JsonText{R"({"exponent":16})"}}};

// A table of strand but for one attribute, which is another or is none.
Attributes strand_but(const std::string& name, const std::optional<AttributeValue>& value) {
  Attributes attributes;
  for (const auto& [known, old] : kStrand)
    if (known != name) attributes.emplace_back(known, old);
  if (value) attributes.emplace_back(name, *value);
  return attributes;
}

void expect_refused(const Image& texels, const Attributes& attributes, const std::string& why) {
  const ScratchDir dir;
  write_image(dir / "t.exr", FileType::kExr, SampleType::kFloat, texels, attributes);
  EXPECT_ERROR(read_table(dir / "t.exr"), ErrorKind::kMalformed, "t.exr': " + why);
}

TEST(BrdfTableFile, DamagedAttributesAreRefused) {
  const auto refused = [](const std::string& attribute, const std::optional<AttributeValue>& value,
                          const std::string& why) {
    expect_refused(Image(6, 4, 4), strand_but(attribute, value), why);
  };
  for (const char* attribute : {"burnish:function", "burnish:sampling", "burnish:layout", "burnish:parameters"})
    refused(attribute, std::nullopt, std::string("expected a lookup table, got an image without ") + attribute);
  refused("burnish:domain", std::nullopt,
          "expected burnish:domain of the lower and upper end of each argument, got none");
  refused("burnish:domain", "-1:1", "expected burnish:domain of the lower and upper end of each argument, got none");
  refused("burnish:domain", Numbers{-1, 1, 0}, "expected burnish:domain of two numbers an argument, got 3 numbers");
  refused("burnish:domain", Numbers{-1, 1}, "domain: strand: expected 2 range(s) A:B, got 1");
  refused("burnish:domain", Numbers{-1, 1, -1, 2}, "domain: strand, V·T: expected from -1 to 1, got -1:2");
  refused("burnish:function", "phong",
          "expected burnish:function banks-r, blinn-phong-f, ward-s, ward-e, strand or light-factor, got 'phong'");
  refused("burnish:function", "ward-e", "expected burnish:parameters such as {} for ward-e, got '{\"exponent\":16}'");
  refused("burnish:sampling", "corner", "expected burnish:sampling edge or centre, got 'corner'");
  refused("burnish:layout", "folded", "expected burnish:layout plain, offset-half or cube-z, got 'folded'");
  for (const char* junk : {"{", "[]", "16", "{}", R"({"exponent":"16"})", R"({"exponent":16,"light":1})"})
    refused("burnish:parameters", junk, "expected burnish:parameters such as {\"exponent\":16.0} for strand, got '");
  refused("burnish:parameters", R"({"exponent":-1})", "exponent: expected a number above 0, got -1");
}

TEST(BrdfTableFile, SizesChannelsAndTexelsThatDoNotFitAreRefused) {
  expect_refused(Image(6, 4, 3), kStrand, "expected 4 channels of a table of strand, got 3");
  expect_refused(Image(6, 5, 4), strand_but("burnish:layout", "offset-half"),
                 "size: the layout offset-half needs an even height, got 5");
  expect_refused(Image(6, 1, 4), strand_but("burnish:sampling", "edge"),
                 "size: expected a height of 2 to 32768, got 1");
  Attributes cube = strand_but("burnish:layout", "cube-z");
  cube[2].second = "edge";
  expect_refused(Image(6, 4, 4), cube, "sampling: the layout cube-z needs centre, got edge");
  cube[2].second = "centre";
  cube[1].second = Numbers{-1, 1, 0, 1};
  expect_refused(Image(6, 4, 4), cube, "domain: the layout cube-z needs -1:1,-1:1, got -1:1,0:1");
  expect_refused(Image(6, 2),
                 {{"burnish:function", "ward-s"},
                  {"burnish:domain", Numbers{0.5, 1}},
                  {"burnish:sampling", "edge"},
                  {"burnish:layout", "plain"},
                  {"burnish:parameters", JsonText{"{}"}}},
                 "size: ward-s has one argument; expected N, got 6x2");
  Image texels(6, 4, 4);
  for (const float bad : {NAN, HUGE_VALF}) {
    texels.data[7] = bad;
    expect_refused(texels, kStrand, "expected finite values, got NaN or infinity");
  }
}

TEST(BrdfTableFile, IntegersWithoutTheirScaleAreRefused) {
  const ScratchDir dir;
  const auto refused = [&](const std::optional<AttributeValue>& scale, const std::string& got) {
    write_image(dir / "t.png", FileType::kPng, SampleType::kUint8, Image(6, 4, 4), strand_but("burnish:scale", scale));
    EXPECT_ERROR(read_table(dir / "t.png"), ErrorKind::kMalformed,
                 "t.png': expected burnish:scale of one number a channel" + got);
  };
  refused(std::nullopt, ", got none");
  refused("4", ", got none");
  refused(Numbers{4, 4}, ", each above 0");
  refused(Numbers{4, 4, 4, 0}, ", each above 0");
}

TEST(BrdfTableFile, FilesThatHoldNoAttributesAreWrittenWithoutAScaleAndNotRead) {
  const ScratchDir dir;
  for (const char* file : {"t.tga", "t.bmp"})
    for (const LookupKind kind : kAll) {
      const TableFile t = table(kind);
      if (kind == LookupKind::kWardS || kind == LookupKind::kLightFactor) {
        EXPECT_ERROR(write_table(dir / file, file_type_of(file), SampleType::kUint8, t), ErrorKind::kUnsupported,
                     kind == LookupKind::kWardS ? "divided by its largest value, 4, which " : "largest value, 2.7, wh");
        continue;
      }
      write_table(dir / file, file_type_of(file), SampleType::kUint8, t);
      const Image image = read_image(dir / file);
      ASSERT_EQ(image.channels, t.function.channels()) << file << " " << name(kind);
      for (std::size_t i = 0; i < image.data.size(); i++)
        EXPECT_NEAR(image.data[i], t.table.texels.data[i], 1. / 509) << file << " " << name(kind);
      EXPECT_ERROR(read_table(dir / file), ErrorKind::kMalformed,
                   "expected a lookup table, got an image without burnish:function");
    }
}

TEST(BrdfTableFile, FilesThatAreNoImagesAreRefused) {
  const ScratchDir dir;
  EXPECT_ERROR(read_table(dir / "missing.exr"), ErrorKind::kIo, "missing.exr'");
  write_table(dir / "t.exr", FileType::kExr, SampleType::kFloat, table(LookupKind::kStrand));
  const std::string bytes = testing::bytes_of(dir / "t.exr");
  testing::write_bytes(dir / "short.exr", bytes.substr(0, bytes.size() - 20));
  EXPECT_ERROR(read_table(dir / "short.exr"), ErrorKind::kMalformed, "short.exr'");
  testing::write_bytes(dir / "text.png", "strand");
  EXPECT_ERROR(read_table(dir / "text.png"), ErrorKind::kMalformed, "expected an image");
}

}  // namespace
}  // namespace burnish
