#include "burnish/core/portable_math.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace burnish::portable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
// Numbers of more than 53 bits as sums, whose first terms end in zeros: products with whole numbers up to 2²⁰ are
// exact.
constexpr double kLn2[] = {0x1.62e42fefp-1, 0x1.473de6af278edp-34};
constexpr double kHalfPi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
constexpr double kPerLn2 = 1.4426950408889634, kPerHalfPi = 0.63661977236758134, kPerLn10 = 0.43429448190325183;

// Σ c[i] xⁱ
template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// sign^i / (first + step·i)!
template <std::size_t N>
constexpr std::array<double, N> inverse_factorials(int first, int step, int sign) {
  std::array<double, N> c{};
  double factorial = 1;
  int n = 1, signs = 1;
  for (std::size_t i = 0; i < N; i++, signs *= sign) {
    while (n < first + step * int(i)) factorial *= ++n;
    c[i] = signs / factorial;
  }
  return c;
}
// numerator·sign^i / (3 + 2i)
template <std::size_t N>
constexpr std::array<double, N> odd_fractions(double numerator, int sign) {
  std::array<double, N> c{};
  for (std::size_t i = 0; i < N; i++, numerator *= sign) c[i] = numerator / double(3 + 2 * i);
  return c;
}

// The nearest whole number, |x| < 2⁵¹: where the sum's last place is 1, it is rounded to that.
double nearest(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

// x 2^k
double scaled(double x, int k) {
  if (k < -1021 || k > 1023) return std::ldexp(x, k);
  return x * std::bit_cast<double>(std::int64_t(k + 1023) << 52);
}

// x = 2^exponent · m, m in [√½, √2). 0 < x < ∞.
struct Parts {
  double m;
  int exponent;
};
Parts parts_of(double x) {
  if (x < std::numeric_limits<double>::min()) {
    const Parts p = parts_of(x * 0x1p54);
    return {p.m, p.exponent - 54};
  }
  constexpr std::int64_t kBitsOfRootHalf = 0x3fe6a09e667f3bcd;
  const std::int64_t bits = std::bit_cast<std::int64_t>(x), k = (bits - kBitsOfRootHalf) >> 52;
  return {std::bit_cast<double>(bits - (k << 52)), int(k)};
}

// An unevaluated sum, |low| being at most half a last place of high.
struct Sum {
  double high, low;
};
// |a| ≥ |b| or a = 0 (Dekker 1971).
Sum exact_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}
// By halves of 26 bits (Veltkamp, Dekker 1971), since fused multiply-add is not everywhere.
Sum exact_product(double a, double b) {
  const auto halves = [](double x) {
    const double wide = 0x1.0000002p27 * x, high = wide - (wide - x);
    return Sum{high, x - high};
  };
  const Sum s = halves(a), t = halves(b);
  const double high = a * b;
  return {high, ((s.high * t.high - high) + s.high * t.low + s.low * t.high) + s.low * t.low};
}

// k ln 2 + 2 artanh s, s = (m − 1)/(m + 1); relative error 2⁻⁵⁸.
Sum log_of(Parts x) {
  static constexpr auto kSeries = odd_fractions<13>(2, 1);
  const double f = x.m - 1, k = x.exponent;
  const Sum below = exact_sum(2, f);
  const double s = f / below.high, s2 = s * s;
  const Sum product = exact_product(s, below.high);
  const double s_low = (((f - product.high) - product.low) - s * below.low) / below.high;
  const Sum sum = exact_sum(k * kLn2[0], 2 * s);
  return exact_sum(sum.high, sum.low + (s * s2 * polynomial(kSeries, s2) + 2 * s_low + k * kLn2[1]));
}

double exp_of(Sum x) {
  static constexpr auto kSeries = inverse_factorials<13>(2, 1, 1);
  if (std::isnan(x.high)) return x.high;
  if (x.high > 710) return kInfinity;
  if (x.high < -750) return 0;
  const double k = nearest(x.high * kPerLn2);
  const double r = ((x.high - k * kLn2[0]) - k * kLn2[1]) + x.low;
  return scaled(1 + (r + r * r * polynomial(kSeries, r)), int(k));
}

// x = quarter·π/2 + r, |r| ≤ π/4.
struct Reduced {
  int quarter;
  double r;
};
Reduced reduced(double x) {
  if (!(std::abs(x) < 1e6)) x = std::fmod(x, 4 * kHalfPi[0] + 4 * kHalfPi[1]);  // exact, of a 2π that is not
  if (std::isnan(x)) return {0, x};
  const double k = nearest(x * kPerHalfPi);
  return {int(k) & 3, ((x - k * kHalfPi[0]) - k * kHalfPi[1]) - k * kHalfPi[2]};
}
double near_sin(double r) {
  static constexpr auto kSeries = inverse_factorials<9>(3, 2, -1);
  const double r2 = r * r;
  return r - r * r2 * polynomial(kSeries, r2);
}
double near_cos(double r) {
  static constexpr auto kSeries = inverse_factorials<9>(4, 2, -1);
  const double r2 = r * r;
  return 1 - (0.5 * r2 - r2 * r2 * polynomial(kSeries, r2));
}
double quarter_turned_sin(int quarter, double r) {
  const double v = quarter & 1 ? near_cos(r) : near_sin(r);
  return quarter & 2 ? -v : v;
}

// Of t in [0, 1], as arctan(c) + arctan((t − c)/(1 + t c)), c the nearest eighth.
double near_atan(double t) {
  static constexpr auto kSeries = odd_fractions<8>(1, -1);
  static constexpr double kAtanOfEighths[] = {0,
                                              0.12435499454676144,
                                              0.24497866312686415,
                                              0.35877067027057222,
                                              0.46364760900080612,
                                              0.55859931534356244,
                                              0.64350110879328439,
                                              0.71882999962162451,
                                              0.78539816339744831};
  if (std::isnan(t)) return t;
  const int k = int(8 * t + 0.5);
  const double c = k / 8.0, r = (t - c) / (1 + t * c), r2 = r * r;
  return kAtanOfEighths[k] + (r - r * r2 * polynomial(kSeries, r2));
}

}  // namespace

double exp(double x) { return exp_of({x, 0}); }
double exp2(double x) {
  if (!(std::abs(x) < 2000)) return exp(x);  // 0, ∞ or NaN
  const double whole = nearest(x);
  return scaled(exp((x - whole) * (kLn2[0] + kLn2[1])), int(whole));
}

double log(double x) {
  if (!(x > 0)) return x == 0 ? -kInfinity : kNan;
  return x < kInfinity ? log_of(parts_of(x)).high : x;
}
double log2(double x) {
  if (!(x > 0 && x < kInfinity)) return log(x);
  const Parts p = parts_of(x);
  return p.exponent + log_of({p.m, 0}).high * kPerLn2;
}
double log10(double x) { return log(x) * kPerLn10; }

double pow(double x, double y) {
  if (y == 0) return 1;
  if (!(x > 0 && x < kInfinity)) return exp(y * log(x));
  const Sum l = log_of(parts_of(x));
  if (!(std::abs(y * l.high) < 1000)) return exp(y * l.high);  // 0, ∞ or NaN
  const Sum p = exact_product(y, l.high);
  return exp_of({p.high, p.low + y * l.low});
}

double sin(double x) {
  const Reduced a = reduced(x);
  return quarter_turned_sin(a.quarter, a.r);
}
double cos(double x) {
  const Reduced a = reduced(x);
  return quarter_turned_sin(a.quarter + 1, a.r);
}
double tan(double x) { return sin(x) / cos(x); }

double atan2(double y, double x) {
  const double across = std::abs(y), along = std::abs(x);
  const bool steep = across > along;
  const double most = steep ? across : along;
  double angle = most == 0 ? 0.0 : near_atan((steep ? along : across) / most);
  if (steep) angle = kHalfPi[0] - (angle - (kHalfPi[1] + kHalfPi[2]));
  if (std::signbit(x)) angle = 2 * kHalfPi[0] - (angle - 2 * (kHalfPi[1] + kHalfPi[2]));
  return std::copysign(angle, y);
}

double sinh(double x) { return (exp(x) - exp(-x)) / 2; }
double asinh(double x) { return std::copysign(log(std::abs(x) + std::sqrt(x * x + 1)), x); }

}  // namespace burnish::portable
