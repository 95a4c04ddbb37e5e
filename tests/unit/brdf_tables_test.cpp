// Lookup tables: what their texels hold, what a lookup gives, and that the error they report is the one they have.
#include <gtest/gtest.h>

#include "burnish/brdf/tables/table_error.h"
#include "expect_error.h"

namespace burnish {
namespace {

LookupFunction function(LookupKind kind) {
  LookupFunction f;
  f.kind = kind;
  f.domain = default_domain(kind);
  return f;
}

constexpr LookupKind kAll[]{LookupKind::kBanksR, LookupKind::kBlinnPhongF, LookupKind::kWardS,
                            LookupKind::kWardE,  LookupKind::kStrand,      LookupKind::kLightFactor};

TEST(BrdfTables, TexelsHoldTheFunctionAtTheirArguments) {
  for (LookupKind kind : kAll)
    for (TableSampling sampling : {TableSampling::kEdge, TableSampling::kCentre}) {
      const LookupFunction f = function(kind);
      const int width = 24, height = f.arguments() > 1 ? 10 : 1;
      const LookupTable t = bake_table(f, width, height, sampling, TableLayout::kPlain);
      ASSERT_EQ(t.texels.channels, f.channels());
      for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++) {
          const auto argument = [&](int k, int n, Range r) {
            const double share = sampling == TableSampling::kEdge ? k / (n - 1.0) : (k + 0.5) / n;
            return r.least + share * (r.most - r.least);
          };
          const double x = argument(i, width, f.domain[0]), y = height > 1 ? argument(j, height, f.domain[1]) : 0;
          double exact[4];
          float found[4];
          f.evaluate(x, y, exact);
          t.look_up(float(x), float(y), found);
          for (int c = 0; c < f.channels(); c++) {
            EXPECT_EQ(t.texels.at(i, j)[c], float(exact[c])) << name(kind);
            EXPECT_NEAR(found[c], exact[c], 1e-4 * (1 + std::abs(exact[c])))
                << name(kind) << ": between texels by rounding";
          }
        }
    }
}

TEST(BrdfTables, ALookupIsLinearBetweenTexelsAndClampsBeyondTheEnds) {
  LookupFunction f = function(LookupKind::kBanksR);
  f.approximate = true;  // linear, so that a table has no error but at the clamped ends
  for (TableSampling sampling : {TableSampling::kEdge, TableSampling::kCentre}) {
    const LookupTable t = bake_table(f, 8, 1, sampling, TableLayout::kPlain);
    const double end = sampling == TableSampling::kEdge ? 0 : 1.0 / 16;
    for (double s = -0.5; s <= 1.5; s += 1.0 / 64) {
      float r;
      t.look_up(float(s), 0, &r);
      EXPECT_NEAR(r, 1 - std::clamp(s, end, 1 - end), 1e-6) << s;
    }
  }
}

TEST(BrdfTables, OffsetHalfIsShiftedAndCubeZIsTurnedOver) {
  const LookupFunction f = function(LookupKind::kStrand);
  const LookupTable plain = bake_table(f, 16, 8, TableSampling::kCentre, TableLayout::kPlain),
                    shifted = bake_table(f, 16, 8, TableSampling::kCentre, TableLayout::kOffsetHalf),
                    cube = bake_table(f, 16, 8, TableSampling::kCentre, TableLayout::kCubeZ);
  for (int y = 0; y < 8; y++)
    for (int x = 0; x < 16; x++)
      for (int c = 0; c < 4; c++) {
        EXPECT_EQ(shifted.texels.at((x + 8) % 16, (y + 4) % 8)[c], plain.texels.at(x, y)[c]);
        EXPECT_EQ(cube.texels.at(x, 7 - y)[c], plain.texels.at(x, y)[c]);
      }
  float a[4], b[4], c[4];
  for (double l = -0.9; l < 0.9; l += 0.13)
    for (double v = -0.85; v < 0.85; v += 0.17) {
      plain.look_up(float(l), float(v), a), shifted.look_up(float(l), float(v), b), cube.look_up(float(l), float(v), c);
      for (int k = 0; k < 4; k++) {
        EXPECT_NEAR(a[k], b[k], 1e-6);
        EXPECT_EQ(a[k], c[k]);
      }
    }
}

TEST(BrdfTables, ARepeatFilterMixesTheEndsAndTheReportSaysSo) {
  LookupFunction f = function(LookupKind::kStrand);
  f.exponent = 50;
  const LookupTable t = bake_table(f, 64, 64, TableSampling::kCentre, TableLayout::kOffsetHalf);
  const TableErrors e = table_errors(f, t);
  float corner[4];
  t.look_up(1, -1, corner);  // specular 1 at (1, −1) and (−1, 1), 0 at the other two
  EXPECT_LT(corner[3], 0.6);
  EXPECT_GE(e.wrap, 0.4);
  EXPECT_GE(e.max_abs, e.wrap);
  EXPECT_EQ(table_errors(f, bake_table(f, 64, 64, TableSampling::kCentre, TableLayout::kPlain)).wrap, 0);
}

TEST(BrdfTables, TheReportedErrorIsThatOfADenserSearch) {
  for (LookupKind kind : {LookupKind::kBanksR, LookupKind::kWardS, LookupKind::kLightFactor}) {
    const LookupFunction f = function(kind);
    const LookupTable t = bake_table(f, 64, 1, TableSampling::kEdge, TableLayout::kPlain);
    const TableErrors e = table_errors(f, t);
    double most = 0, squares = 0;
    constexpr int kPlaces = 630000;
    for (int i = 0; i <= kPlaces; i++) {
      const double x = f.domain[0].least + i / double(kPlaces) * (f.domain[0].most - f.domain[0].least);
      double exact[4];
      float found[4];
      f.evaluate(x, 0, exact);
      t.look_up(float(x), 0, found);
      most = std::max(most, std::abs(found[0] - exact[0]));
      squares += (found[0] - exact[0]) * (found[0] - exact[0]);
    }
    EXPECT_NEAR(e.max_abs, most, 0.01 * most) << name(kind);
    EXPECT_NEAR(e.rms, std::sqrt(squares / (kPlaces + 1)), 0.01 * e.rms) << name(kind);
  }
  // √h/4 next to the root's vertical end.
  const LookupFunction r = function(LookupKind::kBanksR);
  EXPECT_NEAR(table_errors(r, bake_table(r, 101, 1, TableSampling::kEdge, TableLayout::kPlain)).max_abs, 0.025, 1e-6);
}

TEST(BrdfTables, StoredSamplesErrByTheirOwnPrecision) {
  const LookupFunction f = function(LookupKind::kWardS);
  const LookupTable t = bake_table(f, 256, 1, TableSampling::kEdge, TableLayout::kPlain);
  EXPECT_EQ(table_scale(t), 10);
  const auto worst = [&](SampleType sample) {
    const LookupTable stored = as_stored(t, sample);
    double most = 0;
    for (std::size_t i = 0; i < t.texels.data.size(); i++)
      most = std::max(most, std::abs(double(stored.texels.data[i]) - t.texels.data[i]) / t.texels.data[i]);
    return most;
  };
  EXPECT_EQ(worst(SampleType::kFloat), 0);
  EXPECT_LE(worst(SampleType::kHalf), std::exp2(-11));
  EXPECT_GT(worst(SampleType::kHalf), std::exp2(-12));
  EXPECT_LE(worst(SampleType::kUint16), 10 / 65535. / 2 + 1e-6);
  EXPECT_LE(worst(SampleType::kUint8), 10 / 255. / 2 + 1e-6);
  EXPECT_GT(worst(SampleType::kUint8), 10 / 255. / 4);
}

TEST(BrdfTables, TheSmallestTableIsGoodEnoughAndNoneBeforeItIs) {
  const LookupFunction r = function(LookupKind::kBanksR);
  const LookupTable one = smallest_table(r, TableSampling::kEdge, TableLayout::kPlain, SampleType::kFloat, 0.02);
  EXPECT_EQ(one.texels.width, 256) << "√(1/127)/4 is 0.0222, √(1/255)/4 0.0157";
  const LookupFunction ward_e = function(LookupKind::kWardE);
  const LookupTable two = smallest_table(ward_e, TableSampling::kEdge, TableLayout::kPlain, SampleType::kHalf, 0.004);
  EXPECT_LE(table_errors(ward_e, as_stored(two, SampleType::kHalf)).max_abs, 0.004);
  const int texels = two.texels.width * two.texels.height;
  for (int w = 2; w <= texels; w *= 2)
    for (int h = 2; w * h < texels; h *= 2)
      EXPECT_GT(table_errors(ward_e, as_stored(bake_table(ward_e, w, h, TableSampling::kEdge, TableLayout::kPlain),
                                               SampleType::kHalf))
                    .max_abs,
                0.004)
          << w << "x" << h;
  EXPECT_ERROR(smallest_table(r, TableSampling::kEdge, TableLayout::kPlain, SampleType::kUint8, 1e-4),
               ErrorKind::kUsage, "max-error: no table");
  for (const double junk : {0.0, -1.0, double(NAN)})
    EXPECT_ERROR(smallest_table(r, TableSampling::kEdge, TableLayout::kPlain, SampleType::kFloat, junk),
                 ErrorKind::kUsage, "max-error: expected a number above 0, got ");
}

// Where a repeat filter mixes the ends, no size helps.
TEST(BrdfTables, TheSmallestTableIsNotJudgedWhereTheEndsMix) {
  const LookupFunction f = function(LookupKind::kStrand);
  const LookupTable t = smallest_table(f, TableSampling::kCentre, TableLayout::kOffsetHalf, SampleType::kHalf, 0.2);
  EXPECT_LT(t.texels.texels(), 4096u);
  EXPECT_GT(table_errors(f, t).wrap, 0.4);
  // Inside it is the table that is not shifted, whose error there the limit holds for.
  const LookupTable plain = bake_table(f, t.texels.width, t.texels.height, TableSampling::kCentre, TableLayout::kPlain);
  const double inside = 1 - 1.0 / std::min(t.texels.width, t.texels.height);
  for (double x = -inside; x <= inside; x += inside / 100)
    for (double y = -inside; y <= inside; y += inside / 100) {
      double exact[4];
      float found[4];
      f.evaluate(x, y, exact);
      plain.look_up(float(x), float(y), found);
      for (int c = 0; c < 4; c++) ASSERT_NEAR(found[c], exact[c], 0.21) << x << " " << y;
    }
}

// Beyond 2²⁰ texels places are fewer, and there is still one where the root errs most.
TEST(BrdfTables, LargeTablesErrAsTheRootDoes) {
  LookupFunction f = function(LookupKind::kStrand);
  f.exponent = 1;
  const int side = 2048;
  const LookupTable t = bake_table(f, side, 4, TableSampling::kEdge, TableLayout::kPlain),
                    many = bake_table(f, side, 1024, TableSampling::kEdge, TableLayout::kPlain);
  const double few_places = table_errors(f, many).max_abs, many_places = table_errors(f, t).max_abs;
  const double h = 2.0 / (side - 1);
  for (const double error : {few_places, many_places}) EXPECT_GE(error, std::sqrt(2 * h) / 4 * 0.99);
}

TEST(BrdfTables, ProgressNeverGoesBackAndEndsWithTheWork) {
  const LookupFunction f = function(LookupKind::kWardE);
  std::vector<double> seen;
  const Progress progress = [&](double fraction) { seen.push_back(fraction); };
  const LookupTable t = smallest_table(f, TableSampling::kEdge, TableLayout::kPlain, SampleType::kHalf, 0.02, progress);
  EXPECT_GT(seen.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_GE(seen.front(), 0);
  EXPECT_LT(seen.back(), 1);
  seen.clear();
  table_errors(f, t, progress);
  EXPECT_GT(seen.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_EQ(seen.back(), 1);
}

TEST(BrdfTables, DomainsThatCrossASingularityAndSizesThatDoNotFitAreRefused) {
  const auto refused = [](LookupKind kind, std::vector<Range> domain, const std::string& why) {
    LookupFunction f = function(kind);
    f.domain = std::move(domain);
    EXPECT_ERROR(require_valid(f), ErrorKind::kUsage, why);
  };
  refused(LookupKind::kWardS, {{0, 1}}, "domain: ward-s, p: expected more than 0, got 0:1");
  refused(LookupKind::kWardE, {{0, 16}, {-1, 1}}, "domain: ward-e, d: expected more than -1, got -1:1");
  refused(LookupKind::kWardE, {{-1, 16}, {0, 1}}, "ward-e, m: expected at least 0");
  refused(LookupKind::kBanksR, {{0, 2}}, "banks-r, s: expected at most 1, got 0:2");
  refused(LookupKind::kBlinnPhongF, {{1, 128}, {-0.1, 1}}, "blinn-phong-f, e: expected at least 0");
  refused(LookupKind::kStrand, {{-1, 1}, {-1.5, 1}}, "strand, V·T: expected from -1 to 1, got -1.5:1");
  refused(LookupKind::kStrand, {{-1, 1}}, "expected 2 range(s) A:B, got 1");
  refused(LookupKind::kWardS, {{1, 0.5}}, "expected two numbers, the lower first, got 1:0.5");
  refused(LookupKind::kWardS, {{0.1, HUGE_VAL}}, "expected two numbers");
  refused(LookupKind::kWardS, {{NAN, 1}}, "expected two numbers");
  refused(LookupKind::kWardS, {{1e-50, 1}}, "expected more than 0, got 1e-50:1");
  refused(LookupKind::kWardE, {{0, 16}, {-1 + 1e-12, 1}}, "expected more than -1, got -0.999999999999:1");
  refused(LookupKind::kWardS, {{1, 1 + 1e-9}}, "expected ends that single precision tells apart, got 1:1.000000001");
  refused(LookupKind::kWardS, {{1, 1e300}}, "expected ends that single precision tells apart, got 1:1e+300");
  const LookupFunction r = function(LookupKind::kBanksR), s = function(LookupKind::kStrand);
  const auto size_refused = [](const LookupFunction& f, int w, int h, TableSampling sampling, TableLayout layout) {
    EXPECT_ERROR(bake_table(f, w, h, sampling, layout), ErrorKind::kUsage, "size: ");
  };
  size_refused(r, 1, 1, TableSampling::kEdge, TableLayout::kPlain);
  size_refused(r, 16, 2, TableSampling::kEdge, TableLayout::kPlain);
  size_refused(r, 40000, 1, TableSampling::kEdge, TableLayout::kPlain);
  size_refused(s, 32768, 32768, TableSampling::kEdge, TableLayout::kPlain);
  size_refused(s, 15, 16, TableSampling::kCentre, TableLayout::kOffsetHalf);
  EXPECT_ERROR(bake_table(s, 16, 16, TableSampling::kEdge, TableLayout::kCubeZ), ErrorKind::kUsage,
               "sampling: the layout cube-z needs centre, got edge");
  LookupFunction narrow = s;
  narrow.domain = {{0, 1}, {-1, 1}};
  for (TableLayout layout : {TableLayout::kOffsetHalf, TableLayout::kCubeZ})
    EXPECT_ERROR(bake_table(narrow, 16, 16, TableSampling::kCentre, layout), ErrorKind::kUsage,
                 std::string("domain: the layout ") + name(layout) + " needs -1:1,-1:1, got 0:1,-1:1");
  EXPECT_NO_THROW(bake_table(narrow, 16, 16, TableSampling::kCentre, TableLayout::kPlain));
  LookupFunction light = function(LookupKind::kLightFactor);
  light.ambient = -0.1;
  EXPECT_ERROR(require_valid(light), ErrorKind::kUsage, "ambient: expected at least 0, got -0.1");
  LookupFunction strand = function(LookupKind::kStrand);
  strand.exponent = 0;
  EXPECT_ERROR(require_valid(strand), ErrorKind::kUsage, "exponent: expected a number above 0, got 0");
}

}  // namespace
}  // namespace burnish
