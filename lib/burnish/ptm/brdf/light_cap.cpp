#include "burnish/ptm/brdf/light_cap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

// A direction of the lune about `middle`: `towards` is where α grows to.
Vec3d on_lune(Vec3d middle, Vec3d towards, double alpha, double w) {
  const Vec3d axis = cross(middle, towards);
  return axis * w + (middle * portable::cos(alpha) + towards * portable::sin(alpha)) * std::sqrt(1 - w * w);
}

}  // namespace

LightCaps::LightCaps(BrdfCoordinates coordinates, int points)
    : coordinates_(coordinates), place_(points), weight_(points) {
  // Newton's steps to the zeros of Legendre's polynomial (Abramowitz & Stegun 25.4.29).
  for (int i = 0; i < points; i++) {
    double x = portable::cos(kPi * (i + 0.75) / (points + 0.5)), slope = 0;
    for (int step = 0; step < 8; step++) {
      double before = 1, now = x;
      for (int k = 2; k <= points; k++) before = std::exchange(now, ((2 * k - 1) * x * now - (k - 1) * before) / k);
      slope = points * (x * now - before) / (x * x - 1);
      x -= now / slope;
    }
    place_[i] = x, weight_[i] = 2 / ((1 - x * x) * slope * slope);
  }
}

void LightCaps::points_at(double x, double y, std::vector<CapPoint>& out) const {
  out.clear();
  const Vec3d n{0, 0, 1}, given{x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))};
  const bool is_half = coordinates_ == BrdfCoordinates::kHalfDifference;
  const Vec3d middle = is_half ? given : n;
  const double sine = portable::hypot(x, y);
  const Vec3d down = sine > 0 ? Vec3d{x / sine, y / sine, 0} : Vec3d{1, 0, 0};
  const Vec3d towards = is_half ? n * sine - down * given.z : down;  // from H to the normal
  const HalfFrame frame = half_frame(middle);
  const double widest = is_half ? portable::atan2(given.z, sine) : kPi / 2;
  for (std::size_t i = 0; i < place_.size(); i++)
    for (std::size_t k = 0; k < place_.size(); k++) {
      const Vec3d d = on_lune(middle, towards, widest * place_[i], place_[k]);
      const double solid_angle = widest * weight_[i] * weight_[k];
      CapPoint p{d, given, d.x, d.y, solid_angle};  // light-view
      if (is_half) {
        p.v = middle * (2 * dot(middle, d)) - d;
        p.u = dot(d, frame.t), p.w = dot(d, frame.b);
      } else if (coordinates_ == BrdfCoordinates::kDifferenceHalf) {
        const HalfFrame f = half_frame(d);
        p.l = f.t * x + f.b * y + d * given.z;
        p.v = d * (2 * dot(d, p.l)) - p.l;
      }
      if (p.l.z > 0 && p.v.z > 0) out.push_back(p);
    }
}

}  // namespace burnish
