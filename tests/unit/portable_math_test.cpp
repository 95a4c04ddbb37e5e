#include "burnish/core/portable_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

namespace burnish {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

// Units in the last place of the true value, which 80 bits hold well enough.
double units_off(double got, long double truth) {
  const double magnitude = std::abs(double(truth)), unit = std::nextafter(magnitude, kInfinity) - magnitude;
  return double(std::abs(got - truth) / unit);
}

using Function = std::function<double(double)>;
using Truth = std::function<long double(long double)>;

void expect_within(double units, const char* name, const Function& f, const Truth& truth, double low, double high) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; i++) {
    const double x = low + (high - low) * (double(random() >> 11) * 0x1p-53);
    ASSERT_LE(units_off(f(x), truth(x)), units) << name << " of " << x;
  }
}

#define EXPECT_WITHIN(units, name, low, high) \
  expect_within(                              \
      units, #name, [](double x) { return portable::name(x); }, [](long double x) { return std::name(x); }, low, high)

TEST(PortableMath, IsWithinThePromisedUnitsOfTheTrueValue) {
  EXPECT_WITHIN(2, exp, -1, 1);
  EXPECT_WITHIN(2, exp, -745, 709);
  EXPECT_WITHIN(2, exp2, -3, 3);
  EXPECT_WITHIN(2, exp2, -1070, 1020);
  EXPECT_WITHIN(2, log, 0, 1);
  EXPECT_WITHIN(2, log, 0.9, 1.1);
  EXPECT_WITHIN(2, log, 0, 1e300);
  EXPECT_WITHIN(2, log2, 0, 10);
  EXPECT_WITHIN(2, log2, 0.9, 1.1);
  EXPECT_WITHIN(2, log10, 0, 10);
  EXPECT_WITHIN(3, sin, -10, 10);
  EXPECT_WITHIN(3, sin, -1e6, 1e6);
  EXPECT_WITHIN(3, cos, -10, 10);
  EXPECT_WITHIN(3, cos, -1e6, 1e6);
  EXPECT_WITHIN(3, tan, -1.5, 1.5);
  EXPECT_WITHIN(3, atan, -1, 1);
  EXPECT_WITHIN(3, atan, -100, 100);
  EXPECT_WITHIN(3, asin, -1, 1);
  EXPECT_WITHIN(3, acos, -1, 1);
  EXPECT_WITHIN(4, sinh, 0.9, 20);
  EXPECT_WITHIN(4, asinh, 1.2, 1e9);
  for (const double y : {0.5, 2.0, 17.3, 1 / 2.4, 2.4, -3.0})
    expect_within(
        2, "pow", [=](double x) { return portable::pow(x, y); },
        [=](long double x) { return std::pow(x, (long double)y); }, 0.001, 2);
  for (const double x : {-1.0, -0.3, 0.2, 5.0})
    expect_within(
        3, "atan2", [=](double y) { return portable::atan2(y, x); },
        [=](long double y) { return std::atan2(y, (long double)x); }, -2, 2);
}

TEST(PortableMath, SmallArgumentsOfHyperbolicSines) {
  for (const double x : {1e-9, 1e-3, 0.1, 0.7}) {
    EXPECT_NEAR(portable::sinh(x), double(std::sinh((long double)x)), 4e-16) << x;
    EXPECT_NEAR(portable::asinh(x), double(std::asinh((long double)x)), 4e-16) << x;
    EXPECT_EQ(portable::asinh(-x), -portable::asinh(x)) << x;
  }
}

TEST(PortableMath, LargeAnglesErrNoMoreThanTheirOwnLastPlace) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; i++) {
    const double x = 1e6 + 1e9 * (double(random() >> 11) * 0x1p-53);
    ASSERT_NEAR(portable::sin(x), double(std::sin((long double)x)), x * 0x1p-53) << x;
    ASSERT_NEAR(portable::cos(x), double(std::cos((long double)x)), x * 0x1p-53) << x;
  }
}

TEST(PortableMath, PowersOfLargeExponentsAreAsNearAsPromised) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; i++) {
    const double x = 0.5 + 1.5 * (double(random() >> 11) * 0x1p-53), y = 1000;
    const double magnitude = std::abs(y * std::log(x));
    ASSERT_LE(units_off(portable::pow(x, y), std::pow((long double)x, (long double)y)), std::max(2.0, magnitude / 10))
        << x;
  }
}

TEST(PortableMath, EndsOfTheDomains) {
  EXPECT_EQ(portable::exp(-1000), 0);
  EXPECT_EQ(portable::exp(1000), kInfinity);
  EXPECT_EQ(portable::exp(-kInfinity), 0);
  EXPECT_EQ(portable::exp2(-5000), 0);
  EXPECT_EQ(portable::exp2(5000), kInfinity);
  EXPECT_EQ(portable::log(0), -kInfinity);
  EXPECT_EQ(portable::log(kInfinity), kInfinity);
  EXPECT_EQ(portable::log2(0), -kInfinity);
  EXPECT_EQ(portable::pow(0, 0), 1);
  EXPECT_EQ(portable::pow(0, 2), 0);
  EXPECT_EQ(portable::pow(0, -1), kInfinity);
  EXPECT_EQ(portable::pow(1, 1e300), 1);
  EXPECT_EQ(portable::pow(0.5, 1e300), 0);
  EXPECT_EQ(portable::pow(2, 1e300), kInfinity);
  EXPECT_EQ(portable::pow(kNan, 0), 1);
  for (const double nan : {portable::exp(kNan), portable::exp2(kNan), portable::log(-1), portable::log2(kNan),
                           portable::log10(kNan), portable::pow(-1, 2), portable::pow(kNan, 1), portable::pow(2, kNan),
                           portable::sin(kNan), portable::cos(kInfinity), portable::tan(kNan), portable::atan2(kNan, 1),
                           portable::atan2(1, kNan), portable::asin(2), portable::acos(-1.1)})
    EXPECT_TRUE(std::isnan(nan));
}

TEST(PortableMath, ExactWhereItCanBe) {
  EXPECT_EQ(portable::exp(0), 1);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_EQ(portable::acos(1), 0);
  EXPECT_EQ(portable::hypot(3, -4), 5);
  for (int k = -1074; k < 1024; k++) {
    const double power = std::ldexp(1, k);
    ASSERT_EQ(portable::exp2(k), power);
    ASSERT_EQ(portable::log2(power), k);
  }
  for (const double x : {0.1, 0.3, 0.7, 0.99}) {
    EXPECT_EQ(portable::pow(x, 1), x);
    EXPECT_LE(portable::pow(x, 0.001), 1);
  }
}

TEST(PortableMath, QuadrantsAndSignsOfZeros) {
  const double pi = 3.14159265358979323846;
  EXPECT_EQ(portable::atan2(1, 0), pi / 2);
  EXPECT_EQ(portable::atan2(-1, 0), -pi / 2);
  EXPECT_EQ(portable::atan2(1, 1), pi / 4);
  EXPECT_EQ(portable::atan2(1, -1), 3 * pi / 4);
  EXPECT_EQ(portable::atan2(-1, -1), -3 * pi / 4);
  EXPECT_EQ(portable::atan2(0.0, -1), pi);
  EXPECT_EQ(portable::atan2(-0.0, -1), -pi);
  EXPECT_EQ(portable::atan2(-0.0, -0.0), -pi);
  EXPECT_FALSE(std::signbit(portable::atan2(0.0, 0.0)));
  EXPECT_TRUE(std::signbit(portable::atan2(-0.0, 0.0)));
  EXPECT_EQ(portable::acos(-1), pi);
  EXPECT_EQ(portable::asin(-1), -pi / 2);
}

// What the whole file is for: these bits on any machine.
TEST(PortableMath, HasTheSameBitsEverywhere) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](double v) { hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211u; };
  for (int i = 1; i < 20000; i++) {
    const double x = i * 0x1.9p-12;
    for (const double v :
         {portable::exp(x), portable::exp(-x), portable::exp2(x), portable::log(x), portable::log2(x),
          portable::log10(x), portable::pow(x, 17.3), portable::pow(x, -0.4), portable::sin(x), portable::cos(x),
          portable::tan(x), portable::atan2(x, 0.7), portable::atan2(x, -2), portable::asin(x / 8),
          portable::acos(x / 8), portable::sinh(x), portable::asinh(x), portable::hypot(x, 1.3)})
      add(v);
  }
  EXPECT_EQ(hash, 0xf50ba3703caf0b1a);
}

}  // namespace
}  // namespace burnish
