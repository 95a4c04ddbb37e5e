#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "burnish/render/frame_names.h"
#include "burnish/render/validate.h"
#include "expect_error.h"
#include "render_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of;

ValidationFiles files_in(const testing::ScratchDir& dir) {
  return {dir / "palette.png", dir / "analytic.png", dir / "difference.png", dir / "report.json", dir / "report.html"};
}

TEST(RenderValidate, ToleranceIsMetByEquality) {
  ErrorMetrics m;
  m.psnr_db = 40, m.max_abs = 0.5, m.rmse = 0.01, m.p95_abs = 0.02;
  Validation v{RenderPath::kPalette, m, 0, 0, check_tolerances({40, 0.5, 0.01, 0.02}, m)};
  EXPECT_TRUE(v.passed());
  EXPECT_EQ(v.misses(), "");
  v.checks = check_tolerances({41, 0.4, {}, 0.02}, m);
  EXPECT_FALSE(v.passed());
  EXPECT_EQ(v.misses(), "min_psnr_db: expected at least 41, got 40; max_abs: expected at most 0.4, got 0.5");
}

TEST(RenderValidate, WritesPicturesAndReports) {
  const testing::ScratchDir dir;
  Scene s = testing::quad_scene(24);
  s.name = "somewhere/rocks.toml";
  s.validation.tolerances.max_abs = 0;
  ObjectAssets a = testing::indexed_assets(s, 16, 64, true);
  a.normals[17] = {0.6f, 0, 0.8f};  // a texel that quantizing would have lost
  const Validation v = validate(s, {a}, RenderPath::kPalette, files_in(dir));
  EXPECT_FALSE(v.passed());
  EXPECT_EQ(v.metrics.pixels, 24u * 24u);
  const auto report = nlohmann::json::parse(bytes_of(dir / "report.json"));
  EXPECT_EQ(report["scene"], "rocks.toml");
  EXPECT_EQ(report["passed"], false);
  EXPECT_EQ(report["stats"]["max_abs"], v.metrics.max_abs);
  const std::string html = bytes_of(dir / "report.html");
  EXPECT_NE(html.find("tolerance not met"), std::string::npos);
  EXPECT_NE(html.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos) << "a PNG's signature";
  EXPECT_EQ(html.find("somewhere"), std::string::npos) << "no folder";
  EXPECT_EQ(html.find("http"), std::string::npos) << "nothing from elsewhere";
}

TEST(RenderValidate, EqualPicturesAreNullDecibelsInJson) {
  const testing::ScratchDir dir;
  Scene s = testing::quad_scene(24);
  s.validation.tolerances.min_psnr_db = 100;
  const Validation v = validate(s, {testing::indexed_assets(s, 16, 64, true)}, RenderPath::kPalette, files_in(dir));
  EXPECT_TRUE(v.passed());
  EXPECT_EQ(v.metrics.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(nlohmann::json::parse(bytes_of(dir / "report.json"))["stats"]["psnr_db"].is_null());
}

TEST(RenderValidate, RefusesWhatHasNoTwinOrShowsNothing) {
  const testing::ScratchDir dir;
  Scene s = testing::quad_scene(4);
  const std::vector<ObjectAssets> assets{testing::indexed_assets(s, 16, 64, true)};
  EXPECT_ERROR(validate(s, assets, RenderPath::kAnalytic, files_in(dir)), ErrorKind::kUsage, "is the twin itself");
  s.objects[0].transform.translation = {9, 0, 0};
  EXPECT_ERROR(validate(s, assets, RenderPath::kPalette, files_in(dir)), ErrorKind::kMalformed,
               "no pixel shows an object");
}

TEST(RenderFrameNames, NumbersAndAuxiliaryImages) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(FrameNames("out/a.png", 1, {}).of_frame(0), Names{"out/a.png"});
  EXPECT_EQ(FrameNames("100%d.png", 1, {}).of_frame(0), Names{"100%d.png"}) << "one frame takes the name as it is";
  EXPECT_EQ(FrameNames("a_%04d.png", 12, {}).of_frame(11), Names{"a_0011.png"});
  EXPECT_EQ(FrameNames("a_%d.png", 12, {}).of_frame(11), Names{"a_11.png"});
  EXPECT_EQ(FrameNames("d/a.b.exr", 1, {Aov::kNormal, Aov::kIndex}).of_frame(0),
            (Names{"d/a.b.exr", "d/a.b.normal.exr", "d/a.b.index.exr"}));
  EXPECT_ERROR(FrameNames("a.png", 2, {}), ErrorKind::kUsage, "expected %d or %04d");
  EXPECT_ERROR(FrameNames("%d_%d.png", 2, {}), ErrorKind::kUsage, "got two");
  EXPECT_ERROR(FrameNames("-", 2, {}), ErrorKind::kUsage, "standard output takes one picture");
  EXPECT_ERROR(FrameNames("-", 1, {Aov::kUv}), ErrorKind::kUsage, "standard output takes one picture");
  EXPECT_ERROR(FrameNames("%d.png", 2001, {Aov::kUv}), ErrorKind::kUsage, "at most 4000 files");
}

TEST(RenderAov, NamesAreChecked) {
  EXPECT_EQ(parse_aovs("normal,index"), (std::vector<Aov>{Aov::kNormal, Aov::kIndex}));
  EXPECT_ERROR(parse_aovs("normal,"), ErrorKind::kUsage, "got ''");
  EXPECT_ERROR(parse_aovs("albedo"), ErrorKind::kUsage, "got 'albedo'");
  EXPECT_ERROR(parse_aovs("uv,uv"), ErrorKind::kUsage, "named twice");
}

TEST(RenderAov, OffTheObjectNumbersAreMinusOneAndVectorsZero) {
  Scene s = testing::quad_scene(2);
  s.objects[0].transform.translation = {0.5, 0, 0};  // the left pixels show nothing
  const Frame f = testing::render(s, testing::indexed_assets(s, 2, 4, true), RenderPath::kPalette,
                                  {Aov::kIndex, Aov::kNormal, Aov::kMaterial});
  EXPECT_EQ(f.aovs[0].data[0], -1);
  EXPECT_EQ(f.aovs[1].data[2], 0);
  EXPECT_GE(f.aovs[0].data[1], 0);
  EXPECT_GT(f.aovs[1].data[5], 0);
  EXPECT_EQ(f.aovs[2].data[1], 0);
}

}  // namespace
}  // namespace burnish
