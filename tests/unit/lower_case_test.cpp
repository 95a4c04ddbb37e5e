#include "burnish/core/lower_case.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(LowerCase, LeavesAllButCapitalsAsTheyAre) {
  EXPECT_EQ(lower_case("AZaz@[`{09.\xc3\x84"), "azaz@[`{09.\xc3\x84");
  EXPECT_EQ(lower_case(""), "");
}

TEST(LowerCase, ExtensionsOfFiles) {
  EXPECT_EQ(lower_case_extension("A/B.PNG"), ".png");
  EXPECT_EQ(lower_case_extension("a.tar.Gz"), ".gz");
  EXPECT_EQ(lower_case_extension("A.B/c"), "");
}

}  // namespace
}  // namespace burnish
