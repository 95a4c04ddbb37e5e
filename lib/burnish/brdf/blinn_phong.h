// Blinn and Phong's model, made anisotropic by longer tangents (Kautz & Seidel, section 3.2):
//
//   e = (1 − (h·t/α_x)² − (h·b/α_y)²)⁺,   L_o = k_s F(N, e),   F(N, e) = (√e)^N
//
// and without root and exponent (their equation 1), which is F at N = 2: L_o = k_s e.
//
// With α_x = α_y = 1 this is k_s (h·n)^N by Pythagoras, but for the sign of h·n, which the squares lose: a surface that
// turns away from the halfway vector would shine. The sign is kept here: L_o = 0 where h·n ≤ 0.
//
// Exchanging l and v changes nothing, since only h is seen of them.
#pragma once

#include <algorithm>

#include "burnish/brdf/local_frame.h"
#include "burnish/core/portable_math.h"

namespace burnish {

struct BlinnPhong {
  double k_s = 1;
  double alpha_x = 1, alpha_y = 1;  // above 0; the smaller, the sharper
  double exponent = 32;             // N ≥ 0
};

// For e in [0,1]; 0⁰ = 1.
inline double blinn_phong_f(double exponent, double e) { return portable::pow(e, 0.5 * exponent); }

// h: unit, or none where light and view are opposite.
inline double blinn_phong_e(const LocalFrame& f, double alpha_x, double alpha_y, Vec3d h) {
  if (!(dot(h, f.n) > 0)) return 0;
  const double x = dot(h, f.t) / alpha_x, y = dot(h, f.b) / alpha_y;
  return std::max(0.0, 1 - x * x - y * y);
}

inline double blinn_phong(const LocalFrame& f, const BlinnPhong& m, Vec3d h) {
  if (!(dot(h, f.n) > 0)) return 0;
  return m.k_s * blinn_phong_f(m.exponent, blinn_phong_e(f, m.alpha_x, m.alpha_y, h));
}
inline double blinn_phong_equation_1(const LocalFrame& f, const BlinnPhong& m, Vec3d h) {
  return m.k_s * blinn_phong_e(f, m.alpha_x, m.alpha_y, h);
}

}  // namespace burnish
