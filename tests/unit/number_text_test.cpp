#include "burnish/core/number_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace burnish {
namespace {

TEST(NumberText, HasTheFewestDigitsThatComeBack) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(0.1f), "0.1");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(number_text(180.0), "180");
  EXPECT_EQ(number_text(-2.5), "-2.5");
  EXPECT_EQ(number_text(0.0), "0");
  for (double x : {1 / 3.0, 1e300, -5e-324, 123456789.125}) EXPECT_EQ(std::strtod(number_text(x).c_str(), nullptr), x);
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace burnish
