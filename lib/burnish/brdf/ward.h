// Ward's model of anisotropic gloss, its specular part (Ward 1992; Kautz & Seidel, section 3.3):
//
//   f_r = k_s / (4π α_x α_y) · S(p) · E(m, d),   L_o = f_r (n·l)⁺
//   S(p) = 1/√p,              p = (l·n)(v·n)
//   E(m, d) = exp(−2m/(1+d)), m = (h·t/α_x)² + (h·b/α_y)², d = h·n
//
// with h = (l+v)/‖l+v‖. 0 where light or view are below the surface or on it. f_r is reciprocal. The albedo is k_s for
// small α seen from straight above, falls with the cosine of the view, and stays below k_s up to 88° from the normal
// for α of at most ½; in the last degree 1/√p lets it grow without bound, as is known of the model.
#pragma once

#include <cmath>

#include "burnish/brdf/local_frame.h"
#include "burnish/core/portable_math.h"

namespace burnish {

struct Ward {
  double k_s = 1;
  double alpha_x = 0.2, alpha_y = 0.2;  // √2 times the RMS slope of the surface along t and along b; above 0
};

inline double ward_s(double p) { return 1 / std::sqrt(p); }
inline double ward_e(double m, double d) { return portable::exp(-2 * m / (1 + d)); }
// k_s / (4π α_x α_y)
inline double ward_scale(const Ward& w) { return w.k_s / (4 * kPi * w.alpha_x * w.alpha_y); }

// Unit vectors, out of the surface. f_r in 1/sr.
inline double ward_brdf(const LocalFrame& f, const Ward& w, Vec3d l, Vec3d v) {
  const double p = dot(l, f.n) * dot(v, f.n);
  if (!(dot(l, f.n) > 0 && dot(v, f.n) > 0)) return 0;
  const Vec3d h = normalized(l + v);
  const double x = dot(h, f.t) / w.alpha_x, y = dot(h, f.b) / w.alpha_y;
  return ward_scale(w) * ward_s(p) * ward_e(x * x + y * y, dot(h, f.n));
}
// L_o per unit of light that falls at a right angle.
inline double ward(const LocalFrame& f, const Ward& w, Vec3d l, Vec3d v) {
  return ward_brdf(f, w, l, v) * dot(f.n, l);
}

}  // namespace burnish
