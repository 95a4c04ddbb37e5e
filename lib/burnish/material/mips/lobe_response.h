// What the models reflect, and how that changes with the lobe, in floats and in a form that vectorises.
//
// The formulas are those of brdf/; p = (n·l)(n·v) counts as no less than 10⁻⁴ in ward, √(1 − (v·t)²) as no less than
// 10⁻³ in banks and e as no less than 10⁻⁶ in blinn-phong, which keeps values and derivatives bounded.
#pragma once

#include <cmath>

#include "burnish/core/vector_math.h"
#include "burnish/material/mips/lobe.h"

namespace burnish::kernels {

struct Cosines {
  float t_l, n_l, t_v, n_v, t_h, b_h, n_h;
};

// L_o for k_s = 1, and its derivatives by the cosines and by ln α_x and ln α_y. No model sees b·l or b·v.
struct Response {
  float value = 0;
  float by_t_l = 0, by_n_l = 0, by_t_v = 0, by_n_v = 0, by_t_h = 0, by_b_h = 0, by_n_h = 0;
  float by_ln_alpha_x = 0, by_ln_alpha_y = 0;
};

inline float larger(float a, float b) { return a > b ? a : b; }
inline float smaller(float a, float b) { return a < b ? a : b; }
// 1 where x > 0. A factor: selecting the result instead would put its computation into a branch.
inline float is_positive(float x) { return x > 0 ? 1.0f : 0.0f; }

struct WardResponse {
  float scale, inverse_x, inverse_y;

  explicit WardResponse(const Lobe& o)
      : scale(float(1 / (4 * kPi * o.alpha_x * o.alpha_y))),
        inverse_x(float(1 / o.alpha_x)),
        inverse_y(float(1 / o.alpha_y)) {}

  [[gnu::always_inline]] Response operator()(const Cosines& c) const {
    constexpr float kLeast = 1e-4f, kTwoOverLn2 = 2.8853900f;
    const float p = c.n_l * c.n_v, bounded = larger(p, kLeast), x = c.t_h * inverse_x, y = c.b_h * inverse_y;
    const float share = 1 / (1 + larger(c.n_h, 0)), e = (x * x + y * y) * share;
    const float lit = is_positive(smaller(c.n_l, c.n_v));
    Response r;
    r.value = lit * scale * c.n_l / std::sqrt(bounded) * exp2_of_negative(-kTwoOverLn2 * e);
    const float half = (p > kLeast ? 0.5f : 0.0f) / bounded;
    r.by_n_l = r.value * (1 / larger(c.n_l, 1e-6f) - half * c.n_v);
    r.by_n_v = -r.value * half * c.n_l;
    r.by_t_h = -4 * x * share * inverse_x * r.value;
    r.by_b_h = -4 * y * share * inverse_y * r.value;
    r.by_n_h = 2 * e * share * r.value;
    r.by_ln_alpha_x = r.value * (4 * x * x * share - 1);
    r.by_ln_alpha_y = r.value * (4 * y * y * share - 1);
    return r;
  }
};

struct BlinnPhongResponse {
  float half_exponent, inverse_x, inverse_y;

  explicit BlinnPhongResponse(const Lobe& o)
      : half_exponent(float(o.exponent / 2)), inverse_x(float(1 / o.alpha_x)), inverse_y(float(1 / o.alpha_y)) {}

  [[gnu::always_inline]] Response operator()(const Cosines& c) const {
    const float x = c.t_h * inverse_x, y = c.b_h * inverse_y, e = 1 - x * x - y * y, bounded = larger(e, 1e-6f);
    Response r;
    r.value = is_positive(smaller(e, c.n_h)) * exp2_of_negative(half_exponent * log2_of(bounded));
    const float by_e = r.value * half_exponent / bounded;
    r.by_t_h = -2 * x * inverse_x * by_e;
    r.by_b_h = -2 * y * inverse_y * by_e;
    r.by_ln_alpha_x = 2 * x * x * by_e;
    r.by_ln_alpha_y = 2 * y * y * by_e;
    return r;
  }
};

struct BanksResponse {
  explicit BanksResponse(const Lobe&) {}

  [[gnu::always_inline]] Response operator()(const Cosines& c) const {
    const float a = c.t_v, b = c.t_l;
    const float across_a = std::sqrt(larger(1 - a * a, 1e-6f)), across_b = std::sqrt(larger(1 - b * b, 1e-6f));
    const float fibre = across_a * across_b - a * b, lit = is_positive(smaller(c.n_l, fibre)), n_l = lit * c.n_l;
    Response r;
    r.value = n_l * fibre;
    r.by_n_l = lit * fibre;
    r.by_t_v = -n_l * (a * across_b / across_a + b);
    r.by_t_l = -n_l * (b * across_a / across_b + a);
    return r;
  }
};

}  // namespace burnish::kernels
