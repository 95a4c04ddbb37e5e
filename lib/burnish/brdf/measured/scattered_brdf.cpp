#include "burnish/brdf/measured/scattered_brdf.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/brdf/measured/half_difference.h"
#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

constexpr double kKnee = 0.01;  // of asinh, in 1/sr: the magnitude from which values count by their logarithm

std::array<double, 4> place_of(const HalfDifference& w) {
  const double root = std::sqrt(w.theta_h / (kPi / 2)), turn = 0.5 * root * portable::sin(w.theta_d);
  return {root, w.theta_d / (kPi / 2), turn * portable::cos(2 * w.phi_d), turn * std::abs(portable::sin(2 * w.phi_d))};
}

template <typename F>
Vec3d each(Vec3d v, F&& f) {
  return {f(v.x), f(v.y), f(v.z)};
}

// Light and view of a cell, the half vector in the xz plane.
std::pair<Vec3d, Vec3d> directions(const HalfDifference& w) {
  const Vec3d h{portable::sin(w.theta_h), 0, portable::cos(w.theta_h)}, away{h.z, 0, -h.x}, across{0, 1, 0};
  const Vec3d d = (away * portable::cos(w.phi_d) + across * portable::sin(w.phi_d)) * portable::sin(w.theta_d);
  return {h * portable::cos(w.theta_d) + d, h * portable::cos(w.theta_d) - d};
}

}  // namespace

ScatteredReflectance::ScatteredReflectance(const std::vector<ReflectanceSample>& samples) {
  for (const ReflectanceSample& s : samples)
    sorted_.push_back(
        {place_of(half_difference(s.l, s.v)), each(s.reflected, [](double f) { return portable::asinh(f / kKnee); })});
  std::ranges::stable_sort(sorted_, {}, [](const Sample& s) { return s.place[0]; });
}

Vec3d ScatteredReflectance::at(Vec3d l, Vec3d v) const {
  const Place place = place_of(half_difference(l, v));
  // The nearest, with one more for R, in ascending order.
  std::array<std::pair<double, const Sample*>, kNearest + 1> nearest;
  nearest.fill({HUGE_VAL, nullptr});
  const auto visit = [&](const Sample& s) {
    double d2 = 0;
    for (std::size_t c = 0; c < place.size(); c++) d2 += (s.place[c] - place[c]) * (s.place[c] - place[c]);
    if (d2 >= nearest.back().first) return;
    auto to = nearest.end() - 1;
    for (; to != nearest.begin() && d2 < (to - 1)->first; to--) *to = *(to - 1);
    *to = {d2, &s};
  };
  // Outwards from where the first coordinate is met, while that alone is not too far.
  const auto near_enough = [&](const Sample& s) {
    return (s.place[0] - place[0]) * (s.place[0] - place[0]) < nearest.back().first;
  };
  const auto middle = std::ranges::lower_bound(sorted_, place[0], {}, [](const Sample& s) { return s.place[0]; });
  auto below = middle, above = middle;
  for (bool more = true; more;) {
    more = false;
    if (below != sorted_.begin() && near_enough(*(below - 1))) visit(*--below), more = true;
    if (above != sorted_.end() && near_enough(*above)) visit(*above++), more = true;
  }

  const double reach = std::sqrt(nearest.back().first);
  Vec3d sum;
  double weights = 0;
  for (std::size_t k = 0; k < kNearest; k++) {
    const double d = std::max(std::sqrt(nearest[k].first), 1e-9);
    const double root = std::max(0.0, reach - d) / d, weight = root * root;
    sum += nearest[k].second->value * weight;
    weights += weight;
  }
  // Where all are as far away as the last, it is as good as any.
  const Vec3d mean = weights > 0 ? sum / weights : nearest.back().second->value;
  return each(mean, [](double a) { return kKnee * portable::sinh(a); });
}

std::shared_ptr<const Brdf> interpolated(const std::vector<ReflectanceSample>& samples,
                                         const HalfDifferenceCells& cells) {
  const ScatteredReflectance scattered(samples);
  std::vector<Vec3f> values(cells.count());
  parallel_for(std::size_t(cells.theta_h) * cells.theta_d, [&](std::size_t i) {
    const double h = (i / cells.theta_d + 0.5) / cells.theta_h, d = (i % cells.theta_d + 0.5) / cells.theta_d;
    Vec3f* row = &values[i * cells.phi_d];
    for (int p = 0; p < cells.phi_d; p++) {
      const int mirrored = cells.phi_d - 1 - p;
      const auto [l, v] = directions({kPi / 2 * h * h, kPi / 2 * d, kPi * (p + 0.5) / cells.phi_d});
      row[p] = mirrored < p ? row[mirrored] : Vec3f(scattered.at(l, v));
    }
  });
  return std::make_shared<const HalfDifferenceTable>(cells, std::move(values));
}

}  // namespace burnish
