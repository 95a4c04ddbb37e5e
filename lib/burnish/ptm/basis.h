// The biquadratic polynomial of a polynomial texture map (Malzbender, Gelb & Wolters 2001; Rost, OpenGL Shading
// Language, 14.4):
//
//   L(u, v) = a₀u² + a₁v² + a₂uv + a₃u + a₄v + a₅
//
// in the order of files, u and v being x and y of the unit vector towards the light.
#pragma once

#include <array>

namespace burnish {

inline constexpr int kPtmTerms = 6;
template <typename T>
using PtmCoefficients = std::array<T, kPtmTerms>;

template <typename T>
PtmCoefficients<T> ptm_terms(T u, T v) {
  return {u * u, v * v, u * v, u, v, T(1)};
}

template <typename T>
T evaluate(const PtmCoefficients<T>& a, T u, T v) {
  return a[0] * u * u + a[1] * v * v + a[2] * u * v + a[3] * u + a[4] * v + a[5];
}

}  // namespace burnish
