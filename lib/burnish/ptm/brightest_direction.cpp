#include "burnish/ptm/brightest_direction.h"

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

constexpr double kFlat = 1e-3;

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

// x = ½ (λI − A)⁻¹ b in the axes of A: (λ − μ_i) x_i = ½ b_i.
struct Disc {
  double mu[2];  // larger first
  double half_b[2];

  double x(int i, double lambda) const { return half_b[i] == 0 ? 0 : half_b[i] / (lambda - mu[i]); }
  double length(double lambda) const { return length_of(x(0, lambda), x(1, lambda)); }

  // The λ above `least` for which ‖x‖ is 1; ‖x‖ falls from above 1 there. Newton's steps on 1/‖x‖, which bends down,
  // stay below it.
  double on_circle(double least) const {
    double lambda = std::max({least, mu[0] + std::abs(half_b[0]), mu[1] + std::abs(half_b[1])});
    for (int step = 0; step < 64; step++) {
      const double r = length(lambda);
      if (!(r > 1)) break;
      double slope = 0;  // of −½‖x‖²
      for (int i = 0; i < 2; i++) slope += half_b[i] == 0 ? 0 : x(i, lambda) * x(i, lambda) / (lambda - mu[i]);
      const double next = lambda + (r - 1) * r * r / slope;
      if (!(next > lambda)) break;
      lambda = next;
    }
    return lambda;
  }
};

}  // namespace

BrightestDirection brightest_direction(const PtmCoefficients<double>& a) {
  BrightestDirection out;
  if (std::all_of(a.begin(), a.end() - 1, [](double c) { return std::abs(c) <= kFlat; })) {
    out.flat = true;
    return out;
  }
  // A = [[a₀, a₂/2], [a₂/2, a₁]], its axes e and e turned by a quarter.
  const double mean = (a[0] + a[1]) / 2, d = (a[0] - a[1]) / 2, h = a[2] / 2, r = length_of(d, h);
  double ex = 1, ey = 0;
  if (r > 0) {
    ex = d >= 0 ? d + r : h, ey = d >= 0 ? h : r - d;
    const double size = length_of(ex, ey);
    ex /= size, ey /= size;
  }
  const Disc disc{{mean + r, mean - r}, {(a[3] * ex + a[4] * ey) / 2, (a[4] * ex - a[3] * ey) / 2}};
  const double least = std::max(0.0, disc.mu[0]);
  double x0, x1;
  // At λ = μ the first component is free where b has none there: A bends up along it, or not at all.
  const bool free = disc.half_b[0] == 0 && disc.mu[0] >= 0;
  if ((free || disc.mu[0] < 0) && disc.length(least) <= 1) {
    x0 = disc.x(0, least), x1 = disc.x(1, least);
    if (free && disc.mu[0] > 0) {
      x0 = std::sqrt(std::max(0.0, 1 - x1 * x1));
      out.on_horizon = true;
      const double u = x0 * ex, v = x0 * ey;
      if (u < 0 || (u == 0 && v < 0)) x0 = -x0;
    }
  } else {
    const double lambda = disc.on_circle(least), size = disc.length(lambda);
    x0 = disc.x(0, lambda) / size, x1 = disc.x(1, lambda) / size;
    out.on_horizon = true;
  }
  const double u = x0 * ex - x1 * ey, v = x0 * ey + x1 * ex;
  out.direction = {u, v, out.on_horizon ? 0 : std::sqrt(std::max(0.0, 1 - u * u - v * v))};
  out.on_horizon = out.direction.z == 0;
  return out;
}

}  // namespace burnish
