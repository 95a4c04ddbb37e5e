#include "burnish/brdf/measured/observer.h"

#include <algorithm>
#include <array>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

// A Gaussian with a width on each side.
double lobe(double x, double middle, double width_below, double width_above) {
  const double t = (x - middle) / (x < middle ? width_below : width_above);
  return portable::exp(-0.5 * t * t);
}

constexpr std::array<double, 41> kDaylight{
    49.98,  54.65,  82.75,  91.49,  93.43,  86.68, 104.86, 117.01, 117.81, 114.86, 115.92, 108.81, 109.35, 107.80,
    104.79, 107.69, 104.41, 104.05, 100.00, 96.33, 95.79,  88.69,  90.01,  89.60,  87.70,  83.29,  83.70,  80.03,
    80.21,  82.28,  78.28,  69.72,  71.61,  74.35, 61.60,  69.89,  75.09,  63.59,  46.42,  66.81,  63.38};

}  // namespace

Vec3d cie_1931_observer(double nm) {
  return {
      1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
      0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
      1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

double daylight_d65(double nm) {
  const double place = std::clamp((nm - kLeastWavelength_nm) / 10, 0.0, double(kDaylight.size() - 1));
  const int first = std::min(int(place), int(kDaylight.size()) - 2);
  return kDaylight[first] + (kDaylight[first + 1] - kDaylight[first]) * (place - first);
}

std::vector<Vec3d> srgb_weights(const std::vector<double>& nm) {
  std::vector<Vec3d> weights;
  Vec3d sum;
  for (std::size_t i = 0; i < nm.size(); i++) {
    const double step = (nm[std::min(i + 1, nm.size() - 1)] - nm[i > 0 ? i - 1 : 0]) / 2;
    const Vec3d xyz = cie_1931_observer(nm[i]) * (daylight_d65(nm[i]) * step);
    weights.push_back({dot(xyz, Vec3d{3.2404542, -1.5371385, -0.4985314}),
                       dot(xyz, Vec3d{-0.9692660, 1.8760108, 0.0415560}),
                       dot(xyz, Vec3d{0.0556434, -0.2040259, 1.0572252})});
    sum += weights.back();
  }
  for (Vec3d& w : weights) w = {w.x / sum.x, w.y / sum.y, w.z / sum.z};
  return weights;
}

}  // namespace burnish
