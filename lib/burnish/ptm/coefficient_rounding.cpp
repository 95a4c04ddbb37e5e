#include "burnish/ptm/coefficient_rounding.h"

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

constexpr int kMostByte = 255;

int nearest_byte(double x) { return int(std::clamp(std::floor(x + 0.5), 0.0, double(kMostByte))); }

}  // namespace

ByteRange byte_range(const PtmCoefficients<double>& least, const PtmCoefficients<double>& most) {
  ByteRange r;
  for (int k = 0; k < kPtmTerms; k++) {
    if (most[k] > least[k]) {
      r.scale[k] = (most[k] - least[k]) / kMostByte;
      // A bias beyond what integers hold needs a coarser scale.
      r.scale[k] = std::max(r.scale[k], std::max(std::abs(least[k]), std::abs(most[k])) / (1 << 24));
      r.bias[k] = int(std::lround(-least[k] / r.scale[k]));
    } else if (least[k] != 0) {
      r.scale[k] = std::abs(least[k]);
      r.bias[k] = least[k] < 0 ? 1 : 0;  // raw is 0, or 1
    }
  }
  return r;
}

CoefficientRounding::CoefficientRounding(const ByteRange& range,
                                         const std::array<PtmCoefficients<double>, kPtmTerms>& normal)
    : range_(range) {
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) h_[i][j] = range.scale[i] * normal[i][j] * range.scale[j];
  // H = UᵀU with U upper triangular, from its first row on.
  std::array<Real, kPtmTerms> u{};
  for (int i = 0; i < kPtmTerms; i++) {
    double diagonal = h_[i][i];
    for (int k = 0; k < i; k++) diagonal -= u[k][i] * u[k][i];
    u[i][i] = std::sqrt(std::max(diagonal, 1e-300));
    for (int j = i + 1; j < kPtmTerms; j++) {
      double sum = h_[i][j];
      for (int k = 0; k < i; k++) sum -= u[k][i] * u[k][j];
      u[i][j] = sum / u[i][i];
    }
  }
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = i + 1; j < kPtmTerms; j++) feedback_[i][j] = u[i][j] / u[i][i];
}

CoefficientRounding::Real CoefficientRounding::in_steps(const PtmCoefficients<float>& a) const {
  Real z;
  for (int k = 0; k < kPtmTerms; k++) z[k] = a[k] / range_.scale[k] + range_.bias[k];
  return z;
}

PtmCoefficients<std::uint8_t> CoefficientRounding::rounded(const PtmCoefficients<float>& a) const {
  const Real z = in_steps(a);
  std::array<int, kPtmTerms> raw;
  Real error;  // raw − z
  for (int i = kPtmTerms - 1; i >= 0; i--) {
    double wanted = z[i];
    for (int j = i + 1; j < kPtmTerms; j++) wanted -= feedback_[i][j] * error[j];
    raw[i] = nearest_byte(wanted);
    error[i] = raw[i] - z[i];
  }

  Real slope{};  // H · error
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) slope[i] += h_[i][j] * error[j];
  const auto may_step = [&](int i, int step) { return raw[i] + step >= 0 && raw[i] + step <= kMostByte; };
  for (int round = 0; round < 16; round++) {
    int best_i = -1, best_j = -1, step_i = 0, step_j = 0;
    double best = -1e-12 * h_[kPtmTerms - 1][kPtmTerms - 1];
    for (int i = 0; i < kPtmTerms; i++)
      for (const int s : {-1, 1}) {
        if (!may_step(i, s)) continue;
        const double alone = 2 * s * slope[i] + h_[i][i];
        if (alone < best) best = alone, best_i = i, step_i = s, best_j = -1;
        for (int j = i + 1; j < kPtmTerms; j++)
          for (const int t : {-1, 1}) {
            const double both = alone + 2 * t * slope[j] + h_[j][j] + 2 * s * t * h_[i][j];
            if (both < best && may_step(j, t)) best = both, best_i = i, step_i = s, best_j = j, step_j = t;
          }
      }
    if (best_i < 0) break;
    const auto take = [&](int i, int step) {
      raw[i] += step;
      for (int k = 0; k < kPtmTerms; k++) slope[k] += step * h_[k][i];
    };
    take(best_i, step_i);
    if (best_j >= 0) take(best_j, step_j);
  }
  PtmCoefficients<std::uint8_t> out;
  std::ranges::transform(raw, out.begin(), [](int r) { return std::uint8_t(r); });
  return out;
}

double CoefficientRounding::squared_error(const PtmCoefficients<float>& a,
                                          const PtmCoefficients<std::uint8_t>& raw) const {
  const Real z = in_steps(a);
  double sum = 0;
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) sum += (raw[i] - z[i]) * h_[i][j] * (raw[j] - z[j]);
  return sum;
}

}  // namespace burnish
