// Banks' model of fibres along the tangent, its specular part (Kautz & Seidel, section 3.1):
//
//   L_o = k_s (n·l)⁺ (R((v·t)²) R((l·t)²) − (v·t)(l·t))⁺,   R(s) = √(1 − s)
//
// per unit of light that falls on the surface at a right angle. R*(s) = 1 − s takes R's place where there is no table
// ("a crude approximation": 0 and 1 are met exactly, and between them it is up to ¼ too small).
//
// Without the factor n·l, exchanging l and v changes nothing.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/brdf/local_frame.h"

namespace burnish {

// s in [0,1]; what rounding puts beyond is taken for the end.
inline double banks_r(double s) { return std::sqrt(std::max(0.0, 1 - s)); }
inline double banks_r_approximate(double s) { return 1 - s; }

// The factor between k_s (n·l)⁺ and L_o, of the cosines a = v·t and b = l·t.
template <typename R>
double banks_fibre(double a, double b, R&& r) {
  return std::max(0.0, r(a * a) * r(b * b) - a * b);
}

// Unit vectors, out of the surface.
inline double banks(const LocalFrame& f, double k_s, Vec3d l, Vec3d v) {
  return k_s * std::max(0.0, dot(f.n, l)) * banks_fibre(dot(v, f.t), dot(l, f.t), banks_r);
}
inline double banks_approximate(const LocalFrame& f, double k_s, Vec3d l, Vec3d v) {
  return k_s * std::max(0.0, dot(f.n, l)) * banks_fibre(dot(v, f.t), dot(l, f.t), banks_r_approximate);
}

}  // namespace burnish
