#include "burnish/render/table_kernels.h"

#include <bit>
#include <cstdint>

#include "burnish/render/lighting/lighting.h"

// A second version for machines with AVX2, chosen when the program starts. Sanitizers do not survive that choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(BURNISH_SANITIZED)
#define BURNISH_VECTOR_UNITS __attribute__((target_clones("avx2", "default")))
#else
#define BURNISH_VECTOR_UNITS
#endif

namespace burnish::kernels {
namespace {

// max(0, x), in a form that vectorises
inline double positive(double x) { return x > 0 ? x : 0.0; }

// ln(1 + f) for f in [√½ − 1, √2 − 1], relative error below 1e-7 (Cephes, logf).
inline float log1p_near_0(float f) {
  float p = 7.0376836292e-2f;
  p = p * f - 1.1514610310e-1f;
  p = p * f + 1.1676998740e-1f;
  p = p * f - 1.2420140846e-1f;
  p = p * f + 1.4249322787e-1f;
  p = p * f - 1.6668057665e-1f;
  p = p * f + 2.0000714765e-1f;
  p = p * f - 2.4999993993e-1f;
  p = p * f + 3.3333331174e-1f;
  const float f2 = f * f;
  return f + (p * f * f2 - 0.5f * f2);
}

// 2^f for f in [−½, ½] (Cephes, exp2f).
inline float exp2_near_0(float f) {
  float p = 1.535336188319500e-4f;
  p = p * f + 1.339887440266574e-3f;
  p = p * f + 9.618437357674640e-3f;
  p = p * f + 5.550332471162809e-2f;
  p = p * f + 2.402264791363012e-1f;
  p = p * f + 6.931472028550421e-1f;
  return p * f + 1.0f;
}

// x = 2^k · (1 + f) with 1 + f in [√½, √2); where k = 0, f is −complement. Then 2^(exponent · (k + log₂(1 + f))).
inline float power_of(float x, float complement, float exponent) {
  constexpr std::int32_t kRootHalf = 0x3f3504f3, kOne = 0x3f800000;
  constexpr float kLog2E = 1.44269504f, kLeast = -125.0f;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t k = (bits - kRootHalf) >> 23;
  const float mantissa = std::bit_cast<float>(bits - (k << 23));
  const float f = k == 0 ? -complement : mantissa - 1.0f;
  const float wanted = exponent * (float(k) + kLog2E * log1p_near_0(f)), y = wanted > kLeast ? wanted : kLeast;
  const std::int32_t whole = std::int32_t(y - 0.5f);  // nearest, since y ≤ 0
  const float scale = std::bit_cast<float>(kOne + (whole << 23));
  const float result = scale * exp2_near_0(y - float(whole));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(result) & -std::int32_t(bits > 0));  // 0 for 0
}

}  // namespace

BURNISH_VECTOR_UNITS void lambert(Normals n, Vec3d l, std::size_t count, float* __restrict out) {
  const double* __restrict x = n.x, * __restrict y = n.y, * __restrict z = n.z;
  for (std::size_t i = 0; i < count; i++) out[i] = float(positive(x[i] * l.x + y[i] * l.y + z[i] * l.z));
}

BURNISH_VECTOR_UNITS void reflect(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out) {
  const double* __restrict x = n.x, * __restrict y = n.y, * __restrict z = n.z, l_dot_v = dot(l, v);
  float* __restrict cosine = out.lambert, * __restrict base = out.base, * __restrict complement = out.complement;
  for (std::size_t i = 0; i < count; i++) {
    const double nl = x[i] * l.x + y[i] * l.y + z[i] * l.z, nv = x[i] * v.x + y[i] * v.y + z[i] * v.z;
    const double kept = nl > kGrazing ? positive(2 * nl * nv - l_dot_v) : 0.0;
    cosine[i] = float(positive(nl));
    base[i] = float(kept);
    complement[i] = float(1 - kept);
  }
}

BURNISH_VECTOR_UNITS void reflect_doubled(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out) {
  const double* __restrict x = n.x, * __restrict y = n.y, * __restrict z = n.z, l_dot_v = dot(l, v);
  float* __restrict cosine = out.lambert, * __restrict base = out.base, * __restrict complement = out.complement;
  for (std::size_t i = 0; i < count; i++) {
    const double nl = x[i] * l.x + y[i] * l.y + z[i] * l.z, nv = x[i] * v.x + y[i] * v.y + z[i] * v.z;
    const double kept = nl > kGrazing ? positive(2 * nl * nv - l_dot_v) : 0.0;
    const double doubled = positive(2 * kept * kept - 1);
    cosine[i] = float(positive(nl));
    base[i] = float(doubled);
    complement[i] = float(1 - doubled);
  }
}

BURNISH_VECTOR_UNITS void power(const float* __restrict base, const float* __restrict complement, float exponent,
                                std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; i++) out[i] = power_of(base[i], complement[i], exponent);
}

BURNISH_VECTOR_UNITS void add(const float* __restrict share, float factor, std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; i++) out[i] += factor * share[i];
}

}  // namespace burnish::kernels
