#include "burnish/render/table_kernels.h"

#include <bit>
#include <cstdint>

#include "burnish/render/lighting/lighting.h"

// Further versions for machines with AVX2 and AVX-512, chosen when the program starts. Sanitizers do not survive that
// choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(BURNISH_SANITIZED)
#define BURNISH_VECTOR_UNITS __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define BURNISH_VECTOR_UNITS
#endif

namespace burnish::kernels {
namespace {

// max(0, x), in a form that vectorises
inline double positive(double x) { return x > 0 ? x : 0.0; }

// log₂(1 + f) for f in [√½ − 1, √2 − 1]: 2/ln 2 · artanh(f / (2 + f)) by a minimax polynomial, relative error 1.2e-7.
inline float log2_1p(float f) {
  const float s = f / (2.0f + f), s2 = s * s;
  return s * (2.88539042f + s2 * (0.96158824f + s2 * 0.59578546f));
}

// 2^f for f in [−½, ½] by a minimax polynomial, relative error 9.2e-8; in pairs, which keeps the chain short.
inline float exp2_near_0(float f) {
  const float f2 = f * f;
  const float low = 1.0f + f * 0.693147004f, middle = 0.240222424f + f * 0.0555073358f,
              high = 0.00967151299f + f * 0.00132647273f;
  return low + f2 * (middle + f2 * high);
}

// x = 2^k · (1 + f) with 1 + f in [√½, √2); where k = 0, f is −complement. Then 2^(exponent · (k + log₂(1 + f))).
inline float power_of(float x, float complement, float exponent) {
  constexpr std::int32_t kRootHalf = 0x3f3504f3, kOne = 0x3f800000;
  constexpr float kLeast = -125.0f;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x), k = (bits - kRootHalf) >> 23;
  const float mantissa = std::bit_cast<float>(bits - (k << 23));
  const float f = k == 0 ? -complement : mantissa - 1.0f;
  const float wanted = exponent * (float(k) + log2_1p(f)), y = wanted > kLeast ? wanted : kLeast;
  const std::int32_t whole = std::int32_t(y - 0.5f);  // the nearest, since y ≤ 0
  const float power = std::bit_cast<float>(kOne + (whole << 23)) * exp2_near_0(y - float(whole));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(power) & -std::int32_t(bits > 0));  // 0 for 0
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

BURNISH_VECTOR_UNITS void add(const float* __restrict share, Vec3f colour, std::size_t count, Colours out) {
  float* __restrict r = out.r, * __restrict g = out.g, * __restrict b = out.b;
  for (std::size_t i = 0; i < count; i++) {
    r[i] += colour.x * share[i];
    g[i] += colour.y * share[i];
    b[i] += colour.z * share[i];
  }
}

}  // namespace burnish::kernels
