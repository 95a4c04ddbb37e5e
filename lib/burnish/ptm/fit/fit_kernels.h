// The sums of a fit over blocks of 64 texels, for whatever vector unit the machine has; results do not depend on it.
//
// A block is 192 samples, R G B a texel. What is said of a sample or texel stands in arrays over the block, a term of
// the polynomial each.
#pragma once

#include <cstdint>
#include <span>

#include "burnish/ptm/basis.h"
#include "burnish/ptm/photos/capture.h"

namespace burnish::kernels {

inline constexpr int kTexels = PhotoBand::kBlockTexels, kSamples = 3 * kTexels;

// The first photograph's samples of a block, and how far those of the next are.
template <typename T>
struct BlockSamples {
  const T* first;
  std::size_t stride;
};

// Six coefficients of every sample.
struct SampleTerms {
  alignas(64) float a[kPtmTerms][kSamples];
};

// Of every texel the colour, its largest channel 255, and the six coefficients of its light.
struct TexelTerms {
  alignas(64) float colour[3][kTexels], a[kPtmTerms][kTexels];
};

// a_k = Σ_i P_ik p_i; of floats in double precision.
void project(BlockSamples<std::uint8_t> p, std::span<const PtmCoefficients<double>> pseudo_inverse, SampleTerms& out);
void project(BlockSamples<float> p, std::span<const PtmCoefficients<double>> pseudo_inverse, SampleTerms& out);

// Of the sums of squares over three channels, G = RᵀR (light_matrix.h): colour · a / 255 that differs least under it.
// The colour c is the first left singular vector of C Rᵀ, C the three channels' coefficients; channels that it would
// make negative are 0. a = 255 Σ_c c C_c / cᵀc. Of a texel that is black in all photographs the colour is white.
void rank_one(const SampleTerms& c, const std::array<PtmCoefficients<double>, kPtmTerms>& r, TexelTerms& out);

// The polynomial of each sample that a colour and the light's polynomial make.
void multiply_out(const TexelTerms& t, SampleTerms& out);

// Σ over photographs and the first `texels` of the block, of (p − clip(L))², clip to 0 … 255, L the polynomial at the
// photograph's light, a row of `terms`. With `leverage`, h / (1 − h) of each photograph and texel, L is what the other
// photographs make it: less h / (1 − h) times the residual, with `colour` its part along the texel's colour, which is
// held. Where the leverage is kAlone the photograph does not count.
inline constexpr float kAlone = -1;
// Of a photograph's leverage h: kAlone where without it nothing says what it should show.
inline float leverage_factor(double h) { return h < 1 - 1e-6 ? float(h / (1 - h)) : kAlone; }
struct Leverage {
  const float* of = nullptr;  // [photograph][kTexels]; none: all photographs took part
  const TexelTerms* colour = nullptr;
};
double squared_error(BlockSamples<std::uint8_t> p, std::span<const PtmCoefficients<double>> terms, const SampleTerms& a,
                     int texels, const Leverage& leverage = {});
double squared_error(BlockSamples<float> p, std::span<const PtmCoefficients<double>> terms, const SampleTerms& a,
                     int texels, const Leverage& leverage = {});

}  // namespace burnish::kernels
