// Images of more texels than were meant to be read.
#include "burnish/core/texel_limit.h"

#include <gtest/gtest.h>

#include "burnish/core/image_io.h"
#include "burnish/core/whole_file.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;
using testing::write_bytes;

class TexelLimit : public ::testing::Test {
 protected:
  ~TexelLimit() override { set_texel_limit(kDefaultTexelLimit); }
};

TEST_F(TexelLimit, OfALargeMapIsPassedByOneTexelMore) {
  EXPECT_NO_THROW(require_within_texel_limit("x", 32768, 32768));
  EXPECT_NO_THROW(require_within_texel_limit("x", 1, 1 << 30));
  EXPECT_ERROR(require_within_texel_limit("x", 32769, 32768), ErrorKind::kUnsupported,
               "max-texels: expected at least 1073774592 for 'x' of 32769x32768 texels, got 1073741824");
}

TEST_F(TexelLimit, NoProductOfSidesWrapsAround) {
  constexpr std::uint32_t kMost = 0xffffffff;
  EXPECT_ERROR(require_within_texel_limit("x", kMost, kMost), ErrorKind::kUnsupported, "18446744065119617025");
  EXPECT_ERROR(require_within_texel_limit("x", 1u << 31, 1u << 31), ErrorKind::kUnsupported, "4611686018427387904");
}

TEST_F(TexelLimit, HoldsForWhatIsReadFromThenOn) {
  const ScratchDir dir;
  write_image(dir / "x.png", FileType::kPng, SampleType::kUint8, Image(5, 3, 1));
  set_texel_limit(15);
  EXPECT_NO_THROW(ImageReader(dir / "x.png"));
  set_texel_limit(14);
  EXPECT_ERROR(ImageReader(dir / "x.png"), ErrorKind::kUnsupported, "x.png' of 5x3 texels, got 14");
}

// A file of holes takes no room: it is refused by its size, not once it is in memory.
TEST(WholeFile, LargerThanItMayBeOrThanMemoryIsNotRead) {
  const ScratchDir dir;
  write_bytes(dir / "x", "text");
  EXPECT_EQ(read_file(dir / "x", 4), "text");
  EXPECT_ERROR(read_file(dir / "x", 3), ErrorKind::kMalformed, "expected at most 3 bytes, got more");
  std::error_code unprovided;
  std::filesystem::resize_file(dir / "x", std::uintmax_t(1) << 43, unprovided);  // 8 TB
  if (unprovided) GTEST_SKIP() << "no file is that large here";
  EXPECT_ERROR(read_file(dir / "x", std::size_t(1) << 44), ErrorKind::kUnsupported,
               "larger than memory: 8796093022208");
}

}  // namespace
}  // namespace burnish
