#include "burnish/ptm/light_matrix.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"

namespace burnish {

LightMatrix light_matrix(const std::vector<Vec3d>& lights, double ridge, const std::string& name) {
  const std::size_t n = lights.size();
  if (n < kPtmTerms)
    throw file_error(ErrorKind::kMalformed, name,
                     "expected at least 6 lights for 6 coefficients, got " + std::to_string(n));
  // Rows of √λ below B turn the ridge into a plain least-squares problem.
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(n + kPtmTerms, kPtmTerms);
  padded.bottomRows(kPtmTerms).diagonal().setConstant(std::sqrt(ridge));
  LightMatrix m;
  for (std::size_t i = 0; i < n; i++) {
    m.terms.push_back(ptm_terms(lights[i].x, lights[i].y));
    padded.row(i) = Eigen::Map<const Eigen::RowVectorXd>(m.terms[i].data(), kPtmTerms);
  }
  const Eigen::MatrixXd normal = padded.topRows(n).transpose() * padded.topRows(n);
  for (int r = 0; r < kPtmTerms; r++)
    for (int c = 0; c < kPtmTerms; c++) m.normal[r][c] = normal(r, c);

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(padded.rows(), kPtmTerms);
  qr.setThreshold(1e-6);
  qr.compute(padded);
  if (qr.rank() < kPtmTerms)
    throw file_error(ErrorKind::kMalformed, name,
                     "expected lights that determine 6 coefficients, got " + std::to_string(n) +
                         " that determine no more than " + std::to_string(qr.rank()) +
                         "; they repeat, or lie on one curve (--ridge accepts them)");
  const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd::Identity(padded.rows(), n));
  m.pseudo_inverse.resize(n);
  for (std::size_t i = 0; i < n; i++)
    for (int k = 0; k < kPtmTerms; k++) m.pseudo_inverse[i][k] = inverse(k, i);
  return m;
}

std::array<PtmCoefficients<double>, kPtmTerms> uniform_normal_matrix() {
  constexpr double u2 = 1 / 3.0, u4 = 1 / 5.0, u2v2 = 1 / 15.0;  // odd powers vanish
  return {{{u4, u2v2, 0, 0, 0, u2},
           {u2v2, u4, 0, 0, 0, u2},
           {0, 0, u2v2, 0, 0, 0},
           {0, 0, 0, u2, 0, 0},
           {0, 0, 0, 0, u2, 0},
           {u2, u2, 0, 0, 0, 1}}};
}

std::array<PtmCoefficients<double>, kPtmTerms> upper_factor(
    const std::array<PtmCoefficients<double>, kPtmTerms>& normal) {
  std::array<PtmCoefficients<double>, kPtmTerms> r{};
  for (int i = 0; i < kPtmTerms; i++) {
    double pivot = normal[i][i];
    for (int k = 0; k < i; k++) pivot -= r[k][i] * r[k][i];
    r[i][i] = std::sqrt(std::max({pivot, 1e-9 * normal[i][i], 1e-300}));
    for (int j = i + 1; j < kPtmTerms; j++) {
      double sum = normal[i][j];
      for (int k = 0; k < i; k++) sum -= r[k][i] * r[k][j];
      r[i][j] = sum / r[i][i];
    }
  }
  return r;
}

}  // namespace burnish
