// Conjugate gradients (Hestenes and Stiefel, "Methods of conjugate gradients for solving linear systems", 1952), for
// unknowns that are vectors of two or three components, one a vertex.
#pragma once

#include <utility>
#include <vector>

namespace burnish {

template <typename Vector>
double dot(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); i++) sum += dot(a[i], b[i]);
  return sum;
}

// Brings `x` nearer to where product(x) is what is wanted, from `residual`, what is wanted less product(x): at most
// `steps` steps, until the squared residual is no more than `solved`. `product` is linear, symmetric and of no negative
// eigenvalue.
template <typename Vector, typename Product>
void solve_by_conjugate_gradients(std::vector<Vector>& x, std::vector<Vector> residual, int steps, double solved,
                                  const Product& product) {
  std::vector<Vector> step = residual;
  double squared = dot(residual, residual);
  for (int i = 0; i < steps && squared > solved; i++) {
    const std::vector<Vector> effect = product(step);
    const double curvature = dot(step, effect);
    if (!(curvature > 0)) return;
    const double far = squared / curvature;
    for (std::size_t v = 0; v < x.size(); v++) x[v] = x[v] + step[v] * far, residual[v] = residual[v] - effect[v] * far;
    const double before = std::exchange(squared, dot(residual, residual));
    for (std::size_t v = 0; v < x.size(); v++) step[v] = residual[v] + step[v] * (squared / before);
  }
}

}  // namespace burnish
