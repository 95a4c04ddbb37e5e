// A weighted sum of squared distances to points, lines and planes in a space of N dimensions, as a quadratic form
// (Garland and Heckbert, "Simplifying surfaces with color and texture using quadric error metrics", 1998, section 3).
#pragma once

#include <array>
#include <cmath>
#include <initializer_list>

namespace burnish {

template <int N>
struct PointN : std::array<double, N> {
  friend PointN operator+(PointN a, const PointN& b) {
    for (int i = 0; i < N; i++) a[i] += b[i];
    return a;
  }
  friend PointN operator-(PointN a, const PointN& b) {
    for (int i = 0; i < N; i++) a[i] -= b[i];
    return a;
  }
  friend PointN operator*(PointN a, double s) {
    for (double& x : a) x *= s;
    return a;
  }
};
template <int N>
double dot(const PointN<N>& a, const PointN<N>& b) {
  double sum = 0;
  for (int i = 0; i < N; i++) sum += a[i] * b[i];
  return sum;
}
template <int N>
PointN<N> normalized(const PointN<N>& a) {
  return a * (1 / std::sqrt(dot(a, a)));
}

// Q(p) = pᵀA p − 2 bᵀp + c.
template <int N>
class Quadric {
 public:
  // Squared distance to what `directions`, orthonormal, span from `at`: a point, a line, a plane.
  static Quadric of_flat(const PointN<N>& at, std::initializer_list<PointN<N>> directions, double weight) {
    Quadric q;
    for (int i = 0; i < N; i++) {
      q.a_[i][i] = weight;
      for (const PointN<N>& e : directions)
        for (int j = 0; j < N; j++) q.a_[i][j] -= weight * e[i] * e[j];
    }
    q.b_ = q.times(at);
    q.c_ = dot(q.b_, at);
    return q;
  }

  Quadric& operator+=(const Quadric& q) {
    for (int i = 0; i < N; i++) a_[i] = a_[i] + q.a_[i];
    b_ = b_ + q.b_;
    c_ += q.c_;
    return *this;
  }
  friend Quadric operator+(Quadric a, const Quadric& b) { return a += b; }

  double operator()(const PointN<N>& p) const { return dot(times(p), p) - 2 * dot(b_, p) + c_; }

  // Where it is least, by Cholesky; `otherwise` where that is no single point.
  PointN<N> minimum(const PointN<N>& otherwise) const {
    std::array<PointN<N>, N> l{};
    PointN<N> x{};
    double scale = 0;
    for (int i = 0; i < N; i++) scale += a_[i][i];
    for (int i = 0; i < N; i++) {
      for (int j = 0; j <= i; j++) {
        double rest = a_[i][j];
        for (int k = 0; k < j; k++) rest -= l[i][k] * l[j][k];
        if (i == j && !(rest > 1e-13 * scale)) return otherwise;
        l[i][j] = i == j ? std::sqrt(rest) : rest / l[j][j];
      }
      double rest = b_[i];
      for (int k = 0; k < i; k++) rest -= l[i][k] * x[k];
      x[i] = rest / l[i][i];
    }
    for (int i = N - 1; i >= 0; i--) {
      for (int k = i + 1; k < N; k++) x[i] -= l[k][i] * x[k];
      x[i] /= l[i][i];
    }
    return x;
  }

 private:
  PointN<N> times(const PointN<N>& p) const {
    PointN<N> out{};
    for (int i = 0; i < N; i++) out[i] = dot(a_[i], p);
    return out;
  }

  std::array<PointN<N>, N> a_{};
  PointN<N> b_{};
  double c_ = 0;
};

}  // namespace burnish
