// Elementary functions from sums, products and comparisons alone, which compilers make vector code of.
//
// Loops over them are vectorised where a function is marked BURNISH_VECTOR_UNITS and its file compiled with
// -fno-trapping-math and -fno-math-errno. Results do not depend on the vector unit, since nothing is contracted.
#pragma once

#include <bit>
#include <cstdint>

// Further versions for machines with AVX2 and AVX-512, chosen when the program starts. Sanitizers do not survive that
// choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(BURNISH_SANITIZED)
#define BURNISH_VECTOR_UNITS __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define BURNISH_VECTOR_UNITS
#endif

namespace burnish::kernels {

// log₂(1 + f) for f in [√½ − 1, √2 − 1]: 2/ln 2 · artanh(f / (2 + f)) by a minimax polynomial, relative error 7e-10.
inline float log2_1p(float f) {
  const float s = f / (2.0f + f), s2 = s * s;
  return s * (2.88539f + s2 * (0.9617988f + s2 * (0.57671666f + s2 * 0.4316915f)));
}

// 2^f for f in [−½, ½] by a minimax polynomial, relative error 2e-9; in pairs, which keeps the chain short.
inline float exp2_near_0(float f) {
  const float f2 = f * f;
  const float low = 1.0f + f * 0.6931472f, middle = 0.24022648f + f * 0.055503324f,
              high = 0.009618437f + f * 0.0013398875f + f2 * 0.00015353362f;
  return low + f2 * (middle + f2 * high);
}

inline constexpr std::int32_t kBitsOfOne = 0x3f800000, kBitsOfRootHalf = 0x3f3504f3;

// 2^x for x ≤ 0, and 2^−125 for what is below that.
[[gnu::always_inline]] inline float exp2_of_negative(float x) {
  const float y = x > -125.0f ? x : -125.0f;
  const std::int32_t whole = std::int32_t(y - 0.5f);  // the nearest, since y ≤ 0
  return std::bit_cast<float>(kBitsOfOne + (whole << 23)) * exp2_near_0(y - float(whole));
}
// log₂ x for normal x > 0.
[[gnu::always_inline]] inline float log2_of(float x) {
  const std::int32_t bits = std::bit_cast<std::int32_t>(x), k = (bits - kBitsOfRootHalf) >> 23;
  return float(k) + log2_1p(std::bit_cast<float>(bits - (k << 23)) - 1.0f);
}

}  // namespace burnish::kernels
