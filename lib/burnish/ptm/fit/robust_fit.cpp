#include "burnish/ptm/fit/robust_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

constexpr int kAbsoluteSteps = 6, kBiweightSteps = 5;
constexpr double kLeastScale = 0.5;  // of 255
constexpr double kTooDark = 3, kTooBright = 4.685;
constexpr double kLeastWeight = 1e-3;

double median_magnitude(const Eigen::VectorXd& r) {
  std::vector<double> m(r.size());
  std::transform(r.begin(), r.end(), m.begin(), [](double x) { return std::abs(x); });
  const auto middle = m.begin() + std::ptrdiff_t(m.size() / 2);
  std::nth_element(m.begin(), middle, m.end());
  return *middle;
}

double biweight(double residual, double scale) {
  const double x = residual / ((residual < 0 ? kTooDark : kTooBright) * scale);
  return std::abs(x) < 1 ? (1 - x * x) * (1 - x * x) : 0;
}

}  // namespace

RobustFit::RobustFit(const LightMatrix& lights, double ridge)
    : terms_(lights.terms.size(), kPtmTerms), pseudo_inverse_(kPtmTerms, lights.terms.size()), ridge_(ridge) {
  for (std::size_t i = 0; i < lights.terms.size(); i++)
    for (int k = 0; k < kPtmTerms; k++) {
      terms_(i, k) = lights.terms[i][k];
      pseudo_inverse_(k, i) = lights.pseudo_inverse[i][k];
    }
}

RobustFit::Matrix RobustFit::normal(const Eigen::VectorXd& w) const {
  return terms_.transpose() * w.asDiagonal() * terms_ + ridge_ * Matrix::Identity();
}

Eigen::VectorXd RobustFit::weights(const Eigen::VectorXd& grey) const {
  Eigen::VectorXd w(grey.size()), residual = grey - terms_ * (pseudo_inverse_ * grey);
  const auto refit = [&] {
    residual = grey - terms_ * normal(w).ldlt().solve(terms_.transpose() * (w.array() * grey.array()).matrix());
  };
  for (int step = 0; step < kAbsoluteSteps; step++) {
    w = residual.array().abs().max(kLeastScale).inverse();
    refit();
  }
  for (int step = 0; step < kBiweightSteps; step++) {
    const double scale = std::max(1.4826 * median_magnitude(residual), kLeastScale);
    w = residual.unaryExpr([&](double r) { return std::max(biweight(r, scale), kLeastWeight); });
    refit();
  }
  if ((w.array() > 0.5).count() < kPtmTerms) w.setOnes();
  return w;
}

template <typename T>
void RobustFit::fit(kernels::BlockSamples<T> p, kernels::SampleTerms& out, float* leverage) const {
  const Eigen::Index n = terms_.rows();
  Eigen::Matrix<double, Eigen::Dynamic, 3> values(n, 3);
  for (int t = 0; t < kernels::kTexels; t++) {
    for (Eigen::Index i = 0; i < n; i++)
      for (int c = 0; c < 3; c++) values(i, c) = double(p.first[p.stride * std::size_t(i) + 3 * t + c]);
    const Eigen::VectorXd w = weights(values.rowwise().mean());
    const Eigen::LDLT<Matrix> solver(normal(w));
    const Eigen::Matrix<double, kPtmTerms, 3> a = solver.solve(terms_.transpose() * (w.asDiagonal() * values));
    for (int k = 0; k < kPtmTerms; k++)
      for (int c = 0; c < 3; c++) out.a[k][3 * t + c] = float(a(k, c));
    if (!leverage) continue;
    const Eigen::Matrix<double, kPtmTerms, Eigen::Dynamic> inverse = solver.solve(terms_.transpose());
    for (Eigen::Index i = 0; i < n; i++)
      leverage[i * kernels::kTexels + t] = kernels::leverage_factor(w[i] * terms_.row(i).dot(inverse.col(i)));
  }
}

template void RobustFit::fit(kernels::BlockSamples<std::uint8_t>, kernels::SampleTerms&, float*) const;
template void RobustFit::fit(kernels::BlockSamples<float>, kernels::SampleTerms&, float*) const;

}  // namespace burnish
