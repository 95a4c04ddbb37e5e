#include "burnish/material/mips/lobe_moments.h"

#include <algorithm>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

// Black lobes have a frame all the same, which counts where all are black.
constexpr double kLeastWeight = 1e-6;

// Some unit vector across n.
Vec3d across(Vec3d n) { return normalized(cross(n, std::abs(n.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0})); }

}  // namespace

LobeMoments::LobeMoments(MaterialModel model, const Lobe& o) {
  const LocalFrame& f = o.frame;
  energy_ = o.k_s * unit_energy(model, o);
  weight_ = std::max(energy_, kLeastWeight);
  exponent_ = weight_ * o.exponent;
  mean_normal_ = f.n;
  normal_ = f.n * weight_;
  tangent_ = f.t * weight_;
  const auto add_square = [&](Vec3d v, double times) {
    second_[0] += v * (v.x * times), second_[1] += v * (v.y * times), second_[2] += v * (v.z * times);
  };
  if (model == MaterialModel::kBanks) {  // fibres have an axis and no width
    add_square(f.t, weight_);
    return;
  }
  const double variance = unit_variance(model, o.exponent) * weight_;
  add_square(f.n, weight_);
  add_square(f.t, variance * o.alpha_x * o.alpha_x);
  add_square(f.b, variance * o.alpha_y * o.alpha_y);
}

void LobeMoments::add(const LobeMoments& o, double w) {
  energy_ += o.energy_ * w, weight_ += o.weight_ * w, exponent_ += o.exponent_ * w;
  mean_normal_ += o.mean_normal_ * w, normal_ += o.normal_ * w, tangent_ += o.tangent_ * w;
  for (int c = 0; c < 3; c++) second_[c] += o.second_[c] * w;
}

Lobe LobeMoments::lobe(MaterialModel model) const {
  Lobe o;
  o.exponent = exponent_ / weight_;
  const Vec3d m = normal_ / weight_;
  const Vec3d n = length(m) > 1e-6 ? normalized(m) : Vec3d{0, 0, 1};  // (0,0,1) where all cancel out
  o.frame = orthonormal_frame(n, tangent_).value_or(LocalFrame{across(n), cross(n, across(n)), n});
  // Σ' in the plane across n.
  const Vec3d t = o.frame.t, b = o.frame.b;
  const auto covariance = [&](Vec3d u, Vec3d v) { return dot(u, second_times(v)) / weight_ - dot(u, m) * dot(v, m); };
  const double tt = covariance(t, t), bb = covariance(b, b), tb = covariance(t, b);
  const double middle = (tt + bb) / 2, reach = portable::hypot((tt - bb) / 2, tb),
               turn_rad = portable::atan2(2 * tb, tt - bb) / 2;
  o.frame.t = t * portable::cos(turn_rad) + b * portable::sin(turn_rad);
  o.frame.b = cross(n, o.frame.t);
  if (model != MaterialModel::kBanks) {
    const double unit = unit_variance(model, o.exponent), least = 1e-12;
    o.alpha_x = std::sqrt(std::max(middle + reach, least) / unit);
    o.alpha_y = std::sqrt(std::max(middle - reach, least) / unit);
  }
  o.k_s = energy_ / unit_energy(model, o);
  return turned_towards(model, o, tangent_);
}

Lobe turned_towards(MaterialModel model, const Lobe& o, Vec3d tangent) {
  const double along_t = dot(o.frame.t, tangent), along_b = dot(o.frame.b, tangent);
  const Vec3d n = o.frame.n;
  const bool exchange = model != MaterialModel::kBanks && std::abs(along_b) > std::abs(along_t);
  Lobe out = o;
  if (exchange) std::swap(out.alpha_x, out.alpha_y);
  out.frame.t = exchange ? o.frame.b : o.frame.t;
  if ((exchange ? along_b : along_t) < 0) out.frame.t = -out.frame.t;
  out.frame.b = cross(n, out.frame.t);
  return out;
}

}  // namespace burnish
