#include "burnish/normal/normal_space.h"

#include <gtest/gtest.h>

#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

std::optional<NormalSpace> read_back(const std::string& file, const Attributes& attributes) {
  const ScratchDir dir;
  const FileType type = file_type_of(file);
  write_image(dir / file, type, default_sample_type(type), Image(2, 1, 3), attributes);
  return recorded_space(ImageReader(dir / file));
}

TEST(NormalSpace, IsReadBackFromFilesThatHoldText) {
  for (const NormalSpace space : {NormalSpace::kTangent, NormalSpace::kObject}) {
    for (const char* file : {"n.png", "n.tif", "n.exr"})
      EXPECT_EQ(read_back(file, space_attributes(space)), space) << file << " " << name(space);
    for (const char* file : {"n.tga", "n.bmp"})
      EXPECT_EQ(read_back(file, space_attributes(space)), std::nullopt) << file;
  }
}

TEST(NormalSpace, DescriptionsOfOtherProgramsSayNothing) {
  EXPECT_EQ(read_back("n.png", {}), std::nullopt);
  for (const char* text : {"a wall", "object", "{\"burnish:scale\":2}", "{\"burnish:space\":", "[1]", "3"})
    for (const char* file : {"n.png", "n.tif"})
      EXPECT_EQ(read_back(file, {{"ImageDescription", text}}), std::nullopt) << file << " " << text;
}

TEST(NormalSpace, AnyOtherSpaceIsRefused) {
  const std::string part = "expected burnish:space tangent or object, got '";
  EXPECT_ERROR(read_back("n.exr", {{"burnish:space", "world"}}), ErrorKind::kMalformed, "n.exr': " + part + "world'");
  EXPECT_ERROR(read_back("n.png", {{"ImageDescription", "{\"burnish:space\":\"\"}"}}), ErrorKind::kMalformed,
               part + "'");
  EXPECT_ERROR(read_back("n.png", {{"ImageDescription", "{\"burnish:space\":7}"}}), ErrorKind::kMalformed, part + "7'");
}

}  // namespace
}  // namespace burnish
