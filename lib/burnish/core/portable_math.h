// Elementary functions in double precision from sums, products, quotients and square roots alone. IEEE 754 says what
// those give, to the bit; libm's own functions differ in the last place from one C library to another, and between
// processors with and without fused multiply-add. What is stored, or chooses what is stored, uses these.
//
// Within 2 units in the last place of the true value, 3 where noted. An angle is in radians. NaN gives NaN.
#pragma once

#include <cmath>

namespace burnish::portable {

double exp(double x);
double exp2(double x);

// x ≥ 0, otherwise NaN; of powers of two log2 is exact.
double log(double x);
double log2(double x);
double log10(double x);

// x ≥ 0, otherwise NaN but for y = 0; 0⁰ is 1. Where |y ln x| > 20, up to |y ln x|/10 units.
double pow(double x, double y);

// Within 3 units. Beyond |x| of 10⁶ the error grows to that of half a last place of x.
double sin(double x);
double cos(double x);
double tan(double x);

// Within 3 units. Arguments are finite; signs of zeros are as in C: atan2(0, 0) is 0.
double atan2(double y, double x);
inline double atan(double x) { return atan2(x, 1); }
inline double asin(double x) { return atan2(x, std::sqrt((1 - x) * (1 + x))); }
inline double acos(double x) { return atan2(std::sqrt((1 - x) * (1 + x)), x); }

// Within 4e-16 where the value is below 1, and within 4 units beyond.
double sinh(double x);
double asinh(double x);

// Squares neither overflow nor vanish for lengths from 1e-150 to 1e150.
inline double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace burnish::portable
