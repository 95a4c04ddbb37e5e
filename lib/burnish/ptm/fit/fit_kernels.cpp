#include "burnish/ptm/fit/fit_kernels.h"

#include <algorithm>
#include <cstring>

#include "burnish/core/vector_math.h"
#include "burnish/ptm/lanes.h"

namespace burnish::kernels {
namespace {

using Matrix = std::span<const PtmCoefficients<double>>;

// Photographs side by side: taken from where they lie far apart, they would fall on the same lines of the caches.
constexpr std::size_t kTogether = 16;

template <typename Sum, typename T>
[[gnu::always_inline]] inline void project_as(BlockSamples<T> p, Matrix inverse, SampleTerms& out) {
  constexpr int kSums = int(sizeof(Lanes) / sizeof(Sum));
  typedef Sum Sums __attribute__((vector_size(sizeof(Lanes))));
  alignas(64) Sum together[kTogether][kSamples];
  Sum weight[kTogether][kPtmTerms];
  alignas(64) Sums sums[kPtmTerms][kSamples / kSums] = {};
  for (std::size_t first = 0; first < inverse.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, inverse.size() - first);
    for (std::size_t i = 0; i < count; i++) {
      const T* samples = p.first + p.stride * (first + i);
      for (int s = 0; s < kSamples; s++) together[i][s] = Sum(samples[s]);
      for (int k = 0; k < kPtmTerms; k++) weight[i][k] = Sum(inverse[first + i][k]);
    }
    for (int s = 0; s < kSamples / kSums; s++) {
      Sums a[kPtmTerms];
      for (int k = 0; k < kPtmTerms; k++) a[k] = sums[k][s];
      for (std::size_t i = 0; i < count; i++) {
        Sums x;
        std::memcpy(&x, together[i] + s * kSums, sizeof x);
        for (int k = 0; k < kPtmTerms; k++) a[k] += x * weight[i][k];
      }
      for (int k = 0; k < kPtmTerms; k++) sums[k][s] = a[k];
    }
  }
  for (int k = 0; k < kPtmTerms; k++)
    for (int s = 0; s < kSamples; s++) out.a[k][s] = float(sums[k][s / kSums][s % kSums]);
}

BURNISH_VECTOR_UNITS void project_bytes(BlockSamples<std::uint8_t> p, Matrix inverse, SampleTerms& out) {
  project_as<float>(p, inverse, out);
}
BURNISH_VECTOR_UNITS void project_floats(BlockSamples<float> p, Matrix inverse, SampleTerms& out) {
  project_as<double>(p, inverse, out);
}

// Symmetric matrices.
struct Symmetric {
  Lanes xx, xy, xz, yy, yz, zz;
};
[[gnu::always_inline]] inline void divide_by_trace(Symmetric& m) {
  const Lanes trace = m.xx + m.yy + m.zz, f = trace > 1e-30f ? 1.0f / trace : trace * 0.0f;
  m.xx *= f, m.xy *= f, m.xz *= f, m.yy *= f, m.yz *= f, m.zz *= f;
}
[[gnu::always_inline]] inline void square(Symmetric& m) {
  m = {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
       m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
       m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

// The power method by squaring: M^256, of which any column is the eigenvector, the largest most exactly.
constexpr int kSquarings = 8;

[[gnu::always_inline]] inline void largest_eigenvector(Symmetric& m, Lanes (&v)[3]) {
  divide_by_trace(m);
  for (int i = 0; i < kSquarings; i++) {
    square(m);
    divide_by_trace(m);
  }
  const auto x_most = (m.xx >= m.yy) & (m.xx >= m.zz), y_most = m.yy >= m.zz;
  v[0] = x_most ? m.xx : y_most ? m.xy : m.xz;
  v[1] = x_most ? m.xy : y_most ? m.yy : m.yz;
  v[2] = x_most ? m.xz : y_most ? m.yz : m.zz;
}

[[gnu::always_inline]] inline void larger_of(Lanes& a, const Lanes& b) { a = b > a ? b : a; }

// An eigenvector as a colour: none of it negative, its largest channel 255; white where it is 0.
[[gnu::always_inline]] inline void to_colour(Lanes (&v)[3]) {
  const Lanes zero = v[0] * 0.0f, sum = v[0] + v[1] + v[2];
  Lanes most = zero;
  for (Lanes& x : v) {
    x = sum < 0.0f ? -x : x;
    larger_of(x, zero);
    larger_of(most, x);
  }
  for (Lanes& x : v) x = most > x ? x / most * 255.0f : zero + 255.0f;
}

// Of kLanes texels, the first of which stands at `c[channel][term]`.
[[gnu::always_inline]] inline void rank_one_of_lanes(const float (&c)[3][kPtmTerms][kTexels],
                                                     const float (&root)[kPtmTerms][kPtmTerms], int first,
                                                     TexelTerms& out) {
  Lanes a[3][kPtmTerms];
  for (int channel = 0; channel < 3; channel++)
    for (int k = 0; k < kPtmTerms; k++) load(c[channel][k] + first, a[channel][k]);
  Symmetric m{};
  for (int i = 0; i < kPtmTerms; i++) {  // C Rᵀ, R upper triangular, a column at a time
    Lanes x[3];
    for (int channel = 0; channel < 3; channel++) {
      x[channel] = root[i][i] * a[channel][i];
      for (int k = i + 1; k < kPtmTerms; k++) x[channel] += root[i][k] * a[channel][k];
    }
    m.xx += x[0] * x[0], m.xy += x[0] * x[1], m.xz += x[0] * x[2];
    m.yy += x[1] * x[1], m.yz += x[1] * x[2], m.zz += x[2] * x[2];
  }
  Lanes colour[3];
  largest_eigenvector(m, colour);
  to_colour(colour);
  const Lanes scale = 255.0f / (colour[0] * colour[0] + colour[1] * colour[1] + colour[2] * colour[2]);
  for (int channel = 0; channel < 3; channel++) store(colour[channel], out.colour[channel] + first);
  for (int k = 0; k < kPtmTerms; k++)
    store(scale * (colour[0] * a[0][k] + colour[1] * a[1][k] + colour[2] * a[2][k]), out.a[k] + first);
}

BURNISH_VECTOR_UNITS void rank_one_of(const SampleTerms& samples, const float (&root)[kPtmTerms][kPtmTerms],
                                      TexelTerms& out) {
  alignas(64) float c[3][kPtmTerms][kTexels];
  for (int k = 0; k < kPtmTerms; k++)
    for (int t = 0; t < kTexels; t++)
      for (int channel = 0; channel < 3; channel++) c[channel][k][t] = samples.a[k][3 * t + channel];
  for (int first = 0; first < kTexels; first += kLanes) rank_one_of_lanes(c, root, first, out);
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
