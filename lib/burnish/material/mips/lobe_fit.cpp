#include "burnish/material/mips/lobe_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "burnish/core/portable_math.h"
#include "burnish/material/mips/lobe_kernels.h"

namespace burnish {
namespace {

using kernels::kShape;
using kernels::LobeSums;
using Shape = Eigen::Matrix<double, kShape, 1>;  // turns about t, b and n; ln α_x, ln α_y

// The lobe turned and widened, by no more than a first-order step is good for.
Lobe moved(const Lobe& o, const Shape& by, AlphaRange range) {
  const auto bounded = [&](int i, double most) { return std::clamp(by[i], -most, most); };
  const double about_t = bounded(0, 0.5), about_b = bounded(1, 0.5), about_n = bounded(2, 0.8);
  const auto& [t, b, n] = o.frame;
  Lobe out = o;
  out.frame = *orthonormal_frame(n + t * about_b - b * about_t, t + b * about_n - n * about_b);
  out.alpha_x = std::clamp(o.alpha_x * portable::exp(bounded(3, 0.7)), range.least, range.most);
  out.alpha_y = std::clamp(o.alpha_y * portable::exp(bounded(4, 0.7)), range.least, range.most);
  return out;
}

class Fit {
 public:
  Fit(MaterialModel model, std::span<const PairBlock> pairs, const float* wanted, const Lobe& start, AlphaRange range)
      : model_(model),
        pairs_(pairs),
        start_(start),
        range_(range),
        scale_(pairs.size() * PairBlock::kPairs),
        scaled_(scale_.size()) {
    constexpr double kHold = 0.1;  // ε
    constexpr float kFloor = 1 / 20.f;
    const float brightness = float(1 / peak(model, start));
    for (std::size_t i = 0; i < scale_.size(); i++) {
      scale_[i] = 1 / std::sqrt(std::sqrt(wanted[i] * brightness + kFloor));
      scaled_[i] = scale_[i] * wanted[i];
      scaled_square_ += double(scaled_[i]) * scaled_[i];
    }
    hold_ = kHold * peak(model, start) * peak(model, start);
    const double width = std::sqrt(2 * unit_variance(model, start.exponent));
    unit_ << width * start.alpha_y, width * start.alpha_x, 0.5, 0.5, 0.5;
  }

  Lobe run() const {
    constexpr int kMostSteps = 20;
    constexpr double kEnough = 1e-3, kMostDamping = 1e4;
    State now = at(moved(start_, Shape::Zero(), range_));
    double damping = 1e-2;
    for (int step = 0; step < kMostSteps && damping < kMostDamping; step++) {
      Shape by;
      if (!descent(now, damping, by)) break;
      const State next = at(moved(now.lobe, by, range_));
      if (next.cost < now.cost) {
        const bool done = now.cost - next.cost < kEnough * next.cost;
        now = next;
        damping *= 0.2;
        if (done) break;
      } else {
        damping *= 8;
      }
    }
    return now.lobe;
  }

 private:
  struct State {
    Lobe lobe;
    Shape away;  // from the start, in units
    LobeSums sums;
    double cost;
  };

  State at(const Lobe& lobe) const {
    State s{lobe, Shape::Zero(), kernels::lobe_sums(model_, lobe, pairs_, scale_.data(), scaled_.data()), 0};
    // k_s is held to its start as one pair more would hold it.
    s.sums.gg += hold_ / (start_.k_s * start_.k_s), s.sums.gw += hold_ / start_.k_s;
    s.lobe.k_s = s.sums.gw / s.sums.gg;
    s.cost = scaled_square_ + hold_ - s.lobe.k_s * s.sums.gw;
    const auto& [t, b, n] = start_.frame;
    s.away << -dot(lobe.frame.n, b), dot(lobe.frame.n, t), dot(lobe.frame.t, b),
        portable::log(lobe.alpha_x / start_.alpha_x), portable::log(lobe.alpha_y / start_.alpha_y);
    for (int i = 0; i < kShape; i++) {
      s.away[i] /= unit_[i];
      s.cost += hold_ * s.away[i] * s.away[i];
    }
    return s;
  }

  // The step downhill, k_s following each; false where there is none.
  bool descent(const State& s, double damping, Shape& by) const {
    Eigen::Matrix<double, kShape, kShape> a = decltype(a)::Zero();  // its lower triangle counts
    Shape down;
    const double k = s.lobe.k_s;
    for (int i = 0; i < kShape; i++) {
      down[i] = k * (s.sums.wd[i] - k * s.sums.gd[i]) - hold_ * s.away[i] / unit_[i];
      for (int j = 0; j <= i; j++) a(i, j) = k * k * (s.sums.dd[i][j] - s.sums.gd[i] * s.sums.gd[j] / s.sums.gg);
      a(i, i) = (a(i, i) + hold_ / (unit_[i] * unit_[i])) * (1 + damping);
    }
    const Eigen::LLT<decltype(a)> factor(a);
    by = factor.solve(down);
    return factor.info() == Eigen::Success;
  }

  MaterialModel model_;
  std::span<const PairBlock> pairs_;
  const Lobe& start_;
  AlphaRange range_;
  std::vector<float> scale_, scaled_;  // what a pair's differences are multiplied by; the wanted L_o so multiplied
  double scaled_square_ = 0, hold_ = 0;
  Shape unit_;
};

}  // namespace

LobeFit fit_lobe(MaterialModel model, std::span<const PairBlock> pairs, const float* wanted, const Lobe& start,
                 AlphaRange range) {
  LobeFit fit{start.k_s > 0 ? Fit(model, pairs, wanted, start, range).run() : start, 0};
  std::vector<float> got(pairs.size() * PairBlock::kPairs);
  kernels::reflectance(model, fit.lobe, pairs, got.data());
  for (std::size_t i = 0; i < got.size(); i++) {
    const double off = double(got[i]) - wanted[i];
    fit.error_square += off * off;
  }
  return fit;
}

}  // namespace burnish
