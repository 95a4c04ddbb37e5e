#include "burnish/render/palette/table_kernels.h"

#include <bit>
#include <cstdint>

#include "burnish/core/vector_math.h"
#include "burnish/render/lighting/lighting.h"

namespace burnish::kernels {
namespace {

// max(0, x), in a form that vectorises
inline double positive(double x) { return x > 0 ? x : 0.0; }

// x = 2^k · (1 + f) with 1 + f in [√½, √2); where k = 0, f is −complement. Then 2^(exponent · (k + log₂(1 + f))).
[[gnu::always_inline]] inline float power_of(float x, float complement, float exponent) {
  const std::int32_t bits = std::bit_cast<std::int32_t>(x), k = (bits - kBitsOfRootHalf) >> 23;
  const float mantissa = std::bit_cast<float>(bits - (k << 23));
  const float f = k == 0 ? -complement : mantissa - 1.0f;
  const float power = exp2_of_negative(exponent * (float(k) + log2_1p(f)));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(power) & -std::int32_t(bits > 0));  // 0 for 0
}

}  // namespace

BURNISH_VECTOR_UNITS void lambert(Normals n, Vec3d l, std::size_t count, float* __restrict out) {
  const double* __restrict x = n.x, * __restrict y = n.y, * __restrict z = n.z;
  for (std::size_t i = 0; i < count; i++) out[i] = float(positive(x[i] * l.x + y[i] * l.y + z[i] * l.z));
}

// `mirrored`: of r·v, the base of the highlight's power.
template <typename Mirrored>
[[gnu::always_inline]] inline void reflect_by(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out,
                                              Mirrored mirrored) {
  const double* __restrict x = n.x, * __restrict y = n.y, * __restrict z = n.z, l_dot_v = dot(l, v);
  float* __restrict cosine = out.lambert, * __restrict base = out.base, * __restrict complement = out.complement;
  for (std::size_t i = 0; i < count; i++) {
    const double nl = x[i] * l.x + y[i] * l.y + z[i] * l.z, nv = x[i] * v.x + y[i] * v.y + z[i] * v.z;
    const double kept = mirrored(nl > kRounding ? positive(2 * nl * nv - l_dot_v) : 0.0);
    cosine[i] = float(positive(nl));
    base[i] = float(kept);
    complement[i] = float(1 - kept);
  }
}

BURNISH_VECTOR_UNITS void reflect(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out) {
  reflect_by(n, l, v, count, out, [](double r_dot_v) { return r_dot_v; });
}

BURNISH_VECTOR_UNITS void reflect_doubled(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out) {
  reflect_by(n, l, v, count, out, [](double r_dot_v) { return positive(2 * r_dot_v * r_dot_v - 1); });
}

BURNISH_VECTOR_UNITS void add(const float* __restrict share, float factor, std::optional<float> start,
                              std::size_t count, float* __restrict out) {
  if (start)
    for (std::size_t i = 0; i < count; i++) out[i] = *start + factor * share[i];
  else
    for (std::size_t i = 0; i < count; i++) out[i] += factor * share[i];
}

BURNISH_VECTOR_UNITS void add(const float* __restrict share, Vec3f colour, std::optional<Vec3f> start,
                              std::size_t count, Colours out) {
  float* __restrict r = out.r, * __restrict g = out.g, * __restrict b = out.b;
  if (start)
    for (std::size_t i = 0; i < count; i++) {
      r[i] = start->x + colour.x * share[i];
      g[i] = start->y + colour.y * share[i];
      b[i] = start->z + colour.z * share[i];
    }
  else
    for (std::size_t i = 0; i < count; i++) {
      r[i] += colour.x * share[i];
      g[i] += colour.y * share[i];
      b[i] += colour.z * share[i];
    }
}

BURNISH_VECTOR_UNITS void add_highlight(const float* __restrict lambert, const float* __restrict base,
                                        const float* __restrict complement, Vec3f diffuse, Vec3f specular,
                                        float exponent, std::optional<Vec3f> start, std::size_t count, Colours out) {
  float* __restrict r = out.r, * __restrict g = out.g, * __restrict b = out.b;
  if (start)
    for (std::size_t i = 0; i < count; i++) {
      const float cosine = lambert[i], power = power_of(base[i], complement[i], exponent);
      r[i] = start->x + (diffuse.x * cosine + specular.x * power);
      g[i] = start->y + (diffuse.y * cosine + specular.y * power);
      b[i] = start->z + (diffuse.z * cosine + specular.z * power);
    }
  else
    for (std::size_t i = 0; i < count; i++) {
      const float cosine = lambert[i], power = power_of(base[i], complement[i], exponent);
      r[i] += diffuse.x * cosine + specular.x * power;
      g[i] += diffuse.y * cosine + specular.y * power;
      b[i] += diffuse.z * cosine + specular.z * power;
    }
}

}  // namespace burnish::kernels
