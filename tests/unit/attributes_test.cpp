#include "burnish/core/attributes.h"

#include <gtest/gtest.h>

#include "burnish/core/image_io.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;
using Numbers = std::vector<double>;

const Attributes kAll{{"burnish:function", "strand"},   {"burnish:domain", Numbers{-1, 1, -0.5, 1}},
                      {"burnish:scale", Numbers{2.5}},  {"burnish:bias", Numbers{0, 0, 0}},
                      {"burnish:range", Numbers{0, 1}}, {"burnish:parameters", JsonText{R"({"exponent":16})"}}};

TEST(Attributes, AreReadBackFromFilesThatHoldThem) {
  const ScratchDir dir;
  for (const char* file : {"a.exr", "a.png", "a.tif"}) {
    const FileType type = file_type_of(file);
    write_image(dir / file, type, default_sample_type(type), Image(2, 1, 3), kAll);
    const ImageReader reader(dir / file);
    EXPECT_EQ(reader.text("burnish:function"), "strand") << file;
    EXPECT_EQ(reader.numbers("burnish:domain"), (Numbers{-1, 1, -0.5, 1})) << file;
    EXPECT_EQ(reader.numbers("burnish:scale"), Numbers{2.5}) << file;
    EXPECT_EQ(reader.numbers("burnish:bias"), (Numbers{0, 0, 0})) << file;
    EXPECT_EQ(reader.numbers("burnish:range"), (Numbers{0, 1})) << file;
    EXPECT_EQ(reader.text("burnish:parameters"), R"({"exponent":16})") << file;
    EXPECT_EQ(reader.text("burnish:nothing"), std::nullopt) << file;
    EXPECT_EQ(reader.numbers("burnish:nothing"), std::nullopt) << file;
    EXPECT_EQ(reader.numbers("burnish:function"), std::nullopt) << file;
  }
}

TEST(Attributes, AreNotInFilesThatHoldNone) {
  const ScratchDir dir;
  for (const char* file : {"a.tga", "a.bmp"}) {
    const FileType type = file_type_of(file);
    write_image(dir / file, type, default_sample_type(type), Image(2, 1, 3), kAll);
    EXPECT_EQ(ImageReader(dir / file).text("burnish:function"), std::nullopt) << file;
  }
}

TEST(Attributes, OfOtherProgramsAreNoNumbers) {
  const ScratchDir dir;
  for (const char* text : {R"({"burnish:scale":[1,"a"]})", R"({"burnish:scale":"2"})", R"({"burnish:scale")", "[2]"}) {
    write_image(dir / "a.png", FileType::kPng, SampleType::kUint8, Image(2, 1, 3), {{"ImageDescription", text}});
    EXPECT_EQ(ImageReader(dir / "a.png").numbers("burnish:scale"), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace burnish
