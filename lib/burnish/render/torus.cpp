#include "burnish/render/torus.h"

#include <array>
#include <cmath>
#include <vector>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

// c₀ + c₁x + … + c₄x⁴.
using Quartic = std::array<double, 5>;

double value(const Quartic& c, double x) { return (((c[4] * x + c[3]) * x + c[2]) * x + c[1]) * x + c[0]; }
Quartic derivative(const Quartic& c) { return {c[1], 2 * c[2], 3 * c[3], 4 * c[4], 0}; }

// Between ends of different signs, where it is monotonic: Newton's steps, halving where they lead out.
double root_between(const Quartic& c, double low, double high) {
  const Quartic slope = derivative(c);
  const bool rises = value(c, high) > 0;
  double x = 0.5 * (low + high);
  for (int step = 0; step < 100; step++) {
    const double y = value(c, x);
    ((y > 0) == rises ? high : low) = x;
    double next = x - y / value(slope, x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-15 * (1 + std::abs(x))) return next;
    x = next;
  }
  return x;
}

// Where it changes its sign within (low, high), ascending: once at most between two roots of its derivative.
std::vector<double> sign_changes(const Quartic& c, int degree, double low, double high) {
  std::vector<double> ends{low}, out;
  if (degree > 1)
    for (const double x : sign_changes(derivative(c), degree - 1, low, high)) ends.push_back(x);
  ends.push_back(high);
  for (std::size_t i = 1; i < ends.size(); i++)
    if ((value(c, ends[i - 1]) > 0) != (value(c, ends[i]) > 0)) out.push_back(root_between(c, ends[i - 1], ends[i]));
  return out;
}

double turns(double y, double x) {
  const double t = portable::atan2(y, x) / (2 * kPi);
  return t < 0 ? t + 1 : t;
}

}  // namespace

std::optional<SurfacePoint> intersect_torus(const Surface& s, const Ray& ray) {
  const double big = s.radius, small = s.tube_radius, speed = length(ray.direction);
  const Vec3d d = ray.direction / speed;
  const double middle = -dot(ray.origin, d);  // distance to the point nearest to the centre, from which it is counted
  const Vec3d o = ray.origin + d * middle;
  const double reach2 = (big + small) * (big + small) - dot(o, o);
  if (!(reach2 > 0)) return {};
  const double k = dot(o, o) + big * big - small * small, across = 4 * big * big;
  const Quartic outside{k * k - across * (o.x * o.x + o.y * o.y), -2 * across * (o.x * d.x + o.y * d.y),
                        2 * k - across * (d.x * d.x + d.y * d.y), 0, 1};
  const double reach = std::sqrt(reach2) * (1 + 1e-9);
  for (const double x : sign_changes(outside, 4, -reach, reach)) {
    if (!(x + middle > 0) || value(derivative(outside), x) > 0) continue;  // behind, or where the ray leaves
    SurfacePoint p{};
    p.t = (x + middle) / speed;
    p.position = o + d * x;
    const double from_axis = portable::hypot(p.position.x, p.position.y);
    const Vec3d outward{p.position.x / from_axis, p.position.y / from_axis, 0};
    p.normal = p.frame_normal = normalized(p.position - outward * big);
    p.tangent = {-outward.y, outward.x, 0};
    p.bitangent = cross(p.normal, p.tangent);
    p.u = turns(outward.y, outward.x), p.v = turns(p.position.z, from_axis - big);
    differentiate(ray, p.normal, p.tangent / (2 * kPi * from_axis), p.bitangent / (2 * kPi * small), p);
    return p;
  }
  return {};
}

}  // namespace burnish
