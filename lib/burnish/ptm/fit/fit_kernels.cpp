#include "burnish/ptm/fit/fit_kernels.h"

#include <algorithm>

#include "burnish/core/vector_math.h"

namespace burnish::kernels {
namespace {

using Matrix = std::span<const PtmCoefficients<double>>;

template <typename Sum, typename T>
[[gnu::always_inline]] inline void project_as(BlockSamples<T> p, Matrix inverse, SampleTerms& out) {
  alignas(64) Sum a[kPtmTerms][kSamples] = {};
  for (std::size_t i = 0; i < inverse.size(); i++) {
    const T* __restrict samples = p.first + p.stride * i;
    Sum w[kPtmTerms];
    for (int k = 0; k < kPtmTerms; k++) w[k] = Sum(inverse[i][k]);
    for (int s = 0; s < kSamples; s++) {
      const Sum x = Sum(samples[s]);
      a[0][s] += w[0] * x;
      a[1][s] += w[1] * x;
      a[2][s] += w[2] * x;
      a[3][s] += w[3] * x;
      a[4][s] += w[4] * x;
      a[5][s] += w[5] * x;
    }
  }
  for (int k = 0; k < kPtmTerms; k++)
    for (int s = 0; s < kSamples; s++) out.a[k][s] = float(a[k][s]);
}

BURNISH_VECTOR_UNITS void project_bytes(BlockSamples<std::uint8_t> p, Matrix inverse, SampleTerms& out) {
  project_as<float>(p, inverse, out);
}
BURNISH_VECTOR_UNITS void project_floats(BlockSamples<float> p, Matrix inverse, SampleTerms& out) {
  project_as<double>(p, inverse, out);
}

// A symmetric matrix over its trace.
struct Symmetric {
  float xx, xy, xz, yy, yz, zz;
};
[[gnu::always_inline]] inline Symmetric of_trace_1(Symmetric m) {
  const float trace = m.xx + m.yy + m.zz;
  const float f = trace > 1e-30f ? 1.0f / trace : 0.0f;
  return {m.xx * f, m.xy * f, m.xz * f, m.yy * f, m.yz * f, m.zz * f};
}
[[gnu::always_inline]] inline Symmetric squared(Symmetric m) {
  return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
          m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
          m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

// The power method by squaring: M^256, of which any column is the eigenvector, the largest most exactly.
constexpr int kSquarings = 8;

[[gnu::always_inline]] inline void colour_of(Symmetric m, float& red, float& green, float& blue) {
  m = of_trace_1(m);
  for (int i = 0; i < kSquarings; i++) m = of_trace_1(squared(m));
  const bool x_most = m.xx >= m.yy && m.xx >= m.zz, y_most = m.yy >= m.zz;
  const float x = x_most   ? m.xx
                  : y_most ? m.xy
                           : m.xz,
              y = x_most   ? m.xy
                  : y_most ? m.yy
                           : m.yz,
              z = x_most   ? m.xz
                  : y_most ? m.yz
                           : m.zz;
  const float sign = x + y + z < 0.0f ? -1.0f : 1.0f;
  const float r = std::max(sign * x, 0.0f), g = std::max(sign * y, 0.0f), b = std::max(sign * z, 0.0f);
  const float most = std::max(r, std::max(g, b)), scale = most > 0.0f ? 255.0f / most : 0.0f;
  red = most > 0.0f ? r * scale : 255.0f;
  green = most > 0.0f ? g * scale : 255.0f;
  blue = most > 0.0f ? b * scale : 255.0f;
}

BURNISH_VECTOR_UNITS void rank_one_of(const SampleTerms& samples, const float (&root)[kPtmTerms][kPtmTerms],
                                      TexelTerms& out) {
  alignas(64) float c[3][kPtmTerms][kTexels], x[3][kPtmTerms][kTexels];
  for (int k = 0; k < kPtmTerms; k++)
    for (int t = 0; t < kTexels; t++) {
      c[0][k][t] = samples.a[k][3 * t];
      c[1][k][t] = samples.a[k][3 * t + 1];
      c[2][k][t] = samples.a[k][3 * t + 2];
    }
  for (int channel = 0; channel < 3; channel++)  // C Rᵀ, R upper triangular
    for (int i = 0; i < kPtmTerms; i++) {
      float* __restrict row = x[channel][i];
      for (int t = 0; t < kTexels; t++) row[t] = root[i][i] * c[channel][i][t];
      for (int k = i + 1; k < kPtmTerms; k++)
        for (int t = 0; t < kTexels; t++) row[t] += root[i][k] * c[channel][k][t];
    }
  for (int t = 0; t < kTexels; t++) {
    Symmetric m{};
    for (int i = 0; i < kPtmTerms; i++) {
      const float r = x[0][i][t], g = x[1][i][t], b = x[2][i][t];
      m.xx += r * r, m.xy += r * g, m.xz += r * b, m.yy += g * g, m.yz += g * b, m.zz += b * b;
    }
    colour_of(m, out.colour[0][t], out.colour[1][t], out.colour[2][t]);
  }
  alignas(64) float scale[kTexels];
  for (int t = 0; t < kTexels; t++)
    scale[t] = 255.0f / (out.colour[0][t] * out.colour[0][t] + out.colour[1][t] * out.colour[1][t] +
                         out.colour[2][t] * out.colour[2][t]);
  for (int k = 0; k < kPtmTerms; k++)
    for (int t = 0; t < kTexels; t++)
      out.a[k][t] =
          scale[t] * (out.colour[0][t] * c[0][k][t] + out.colour[1][t] * c[1][k][t] + out.colour[2][t] * c[2][k][t]);
}

// Adds the squared errors of one photograph to `sum`.
template <typename T>
[[gnu::always_inline]] inline void add_squared_error(const T* __restrict p, const float (&b)[kPtmTerms],
                                                     const SampleTerms& a, const float* leverage,
                                                     const TexelTerms* colour, float (&sum)[kSamples]) {
  alignas(64) float value[kSamples], residual[kSamples];
  for (int s = 0; s < kSamples; s++) {
    value[s] = b[0] * a.a[0][s] + b[1] * a.a[1][s] + b[2] * a.a[2][s] + b[3] * a.a[3][s] + b[4] * a.a[4][s] + a.a[5][s];
    residual[s] = float(p[s]) - value[s];
  }
  if (leverage && colour)
    for (int t = 0; t < kTexels; t++) {
      const float r = colour->colour[0][t], g = colour->colour[1][t], l = colour->colour[2][t];
      const float along = (r * residual[3 * t] + g * residual[3 * t + 1] + l * residual[3 * t + 2]) /
                          (r * r + g * g + l * l) * leverage[t];
      value[3 * t] -= r * along, value[3 * t + 1] -= g * along, value[3 * t + 2] -= l * along;
    }
  else if (leverage)
    for (int t = 0; t < kTexels; t++)
      for (int c = 0; c < 3; c++) value[3 * t + c] -= leverage[t] * residual[3 * t + c];
  for (int s = 0; s < kSamples; s++) {
    const float shown = value[s] < 0.0f ? 0.0f : value[s] > 255.0f ? 255.0f : value[s];
    residual[s] = float(p[s]) - shown;
  }
  if (leverage)
    for (int t = 0; t < kTexels; t++)
      for (int c = 0; c < 3; c++) residual[3 * t + c] = leverage[t] == kAlone ? 0.0f : residual[3 * t + c];
  for (int s = 0; s < kSamples; s++) sum[s] += residual[s] * residual[s];
}

template <typename T>
[[gnu::always_inline]] inline double squared_error_as(BlockSamples<T> p, Matrix terms, const SampleTerms& a, int texels,
                                                      const Leverage& leverage) {
  alignas(64) float sum[kSamples] = {};
  for (std::size_t i = 0; i < terms.size(); i++) {
    const float* h = leverage.of ? leverage.of + i * kTexels : nullptr;
    float b[kPtmTerms];
    for (int k = 0; k < kPtmTerms; k++) b[k] = float(terms[i][k]);
    add_squared_error(p.first + p.stride * i, b, a, h, leverage.colour, sum);
  }
  double total = 0;
  for (int s = 0; s < 3 * texels; s++) total += sum[s];
  return total;
}

BURNISH_VECTOR_UNITS double squared_error_bytes(BlockSamples<std::uint8_t> p, Matrix terms, const SampleTerms& a,
                                                int texels, const Leverage& leverage) {
  return squared_error_as(p, terms, a, texels, leverage);
}
BURNISH_VECTOR_UNITS double squared_error_floats(BlockSamples<float> p, Matrix terms, const SampleTerms& a, int texels,
                                                 const Leverage& leverage) {
  return squared_error_as(p, terms, a, texels, leverage);
}

}  // namespace

void project(BlockSamples<std::uint8_t> p, Matrix inverse, SampleTerms& out) { project_bytes(p, inverse, out); }
void project(BlockSamples<float> p, Matrix inverse, SampleTerms& out) { project_floats(p, inverse, out); }

void rank_one(const SampleTerms& c, const std::array<PtmCoefficients<double>, kPtmTerms>& r, TexelTerms& out) {
  float root[kPtmTerms][kPtmTerms];
  for (int i = 0; i < kPtmTerms; i++) std::copy(r[i].begin(), r[i].end(), root[i]);
  rank_one_of(c, root, out);
}

void multiply_out(const TexelTerms& t, SampleTerms& out) {
  for (int k = 0; k < kPtmTerms; k++)
    for (int s = 0; s < kSamples; s++) out.a[k][s] = t.colour[s % 3][s / 3] * t.a[k][s / 3] / 255.0f;
}

double squared_error(BlockSamples<std::uint8_t> p, Matrix terms, const SampleTerms& a, int texels,
                     const Leverage& leverage) {
  return squared_error_bytes(p, terms, a, texels, leverage);
}
double squared_error(BlockSamples<float> p, Matrix terms, const SampleTerms& a, int texels, const Leverage& leverage) {
  return squared_error_floats(p, terms, a, texels, leverage);
}

}  // namespace burnish::kernels
