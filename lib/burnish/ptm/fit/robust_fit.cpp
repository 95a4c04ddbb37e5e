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

double median_magnitude(const Eigen::VectorXd& r, std::vector<double>& room) {
  room.resize(std::size_t(r.size()));
  std::transform(r.begin(), r.end(), room.begin(), [](double x) { return std::abs(x); });
  const auto middle = room.begin() + std::ptrdiff_t(room.size() / 2);
  std::nth_element(room.begin(), middle, room.end());
  return *middle;
}

double biweight(double residual, double scale) {
  const double x = residual / ((residual < 0 ? kTooDark : kTooBright) * scale);
  return std::abs(x) < 1 ? (1 - x * x) * (1 - x * x) : 0;
}

}  // namespace

RobustFit::RobustFit(const LightMatrix& lights, double ridge)
    : terms_(kPtmTerms, lights.terms.size()),
      pseudo_inverse_(kPtmTerms, lights.terms.size()),
      products_(kPtmTerms * kPtmTerms, lights.terms.size()),
      ridge_(ridge) {
  for (std::size_t i = 0; i < lights.terms.size(); i++)
    for (int k = 0; k < kPtmTerms; k++) {
      terms_(k, i) = lights.terms[i][k];
      pseudo_inverse_(k, i) = lights.pseudo_inverse[i][k];
      for (int j = 0; j < kPtmTerms; j++) products_(k * kPtmTerms + j, i) = lights.terms[i][k] * lights.terms[i][j];
    }
}

RobustFit::Matrix RobustFit::normal(const Eigen::VectorXd& weights) const {
  Matrix sum = ridge_ * Matrix::Identity();
  Eigen::Map<Eigen::Matrix<double, kPtmTerms * kPtmTerms, 1>>(sum.data()).noalias() += products_ * weights;
  return sum;
}

void RobustFit::refit(Texel& t) const {
  t.weighted = t.weight.cwiseProduct(t.grey);
  Eigen::Matrix<double, kPtmTerms, 1> a;
  a.noalias() = terms_ * t.weighted;
  a = normal(t.weight).ldlt().solve(a);
  t.residual = t.grey;
  t.residual.noalias() -= terms_.transpose() * a;
}

void RobustFit::find_weights(Texel& t) const {
  Eigen::Matrix<double, kPtmTerms, 1> plain;
  plain.noalias() = pseudo_inverse_ * t.grey;
  t.residual = t.grey;
  t.residual.noalias() -= terms_.transpose() * plain;
  for (int step = 0; step < kAbsoluteSteps; step++) {
    t.weight = t.residual.array().abs().max(kLeastScale).inverse();
    refit(t);
  }
  for (int step = 0; step < kBiweightSteps; step++) {
    const double scale = std::max(1.4826 * median_magnitude(t.residual, t.magnitude), kLeastScale);
    t.weight = t.residual.unaryExpr([&](double r) { return std::max(biweight(r, scale), kLeastWeight); });
    if (step + 1 < kBiweightSteps) refit(t);
  }
  if ((t.weight.array() > 0.5).count() < kPtmTerms) t.weight.setOnes();
}

template <typename T>
void RobustFit::fit(kernels::BlockSamples<T> p, kernels::SampleTerms& out, float* leverage) const {
  const Eigen::Index n = terms_.cols();
  Eigen::Matrix<double, Eigen::Dynamic, 3> values(n, 3);
  Texel texel;
  for (int t = 0; t < kernels::kTexels; t++) {
    for (Eigen::Index i = 0; i < n; i++)
      for (int c = 0; c < 3; c++) values(i, c) = double(p.first[p.stride * std::size_t(i) + 3 * t + c]);
    texel.grey = values.rowwise().mean();
    find_weights(texel);
    const Eigen::LDLT<Matrix> solver(normal(texel.weight));
    for (int c = 0; c < 3; c++) {
      texel.weighted = texel.weight.cwiseProduct(values.col(c));
      Eigen::Matrix<double, kPtmTerms, 1> a;
      a.noalias() = terms_ * texel.weighted;
      a = solver.solve(a);
      for (int k = 0; k < kPtmTerms; k++) out.a[k][3 * t + c] = float(a[k]);
    }
    if (!leverage) continue;
    const Matrix inverse = solver.solve(Matrix::Identity());
    for (Eigen::Index i = 0; i < n; i++)
      leverage[i * kernels::kTexels + t] =
          kernels::leverage_factor(texel.weight[i] * terms_.col(i).dot(inverse * terms_.col(i)));
  }
}

template void RobustFit::fit(kernels::BlockSamples<std::uint8_t>, kernels::SampleTerms&, float*) const;
template void RobustFit::fit(kernels::BlockSamples<float>, kernels::SampleTerms&, float*) const;

}  // namespace burnish
