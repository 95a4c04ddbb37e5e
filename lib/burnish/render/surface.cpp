#include "burnish/render/surface.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/portable_math.h"
#include "burnish/render/torus.h"

namespace burnish {
namespace {

std::optional<SurfacePoint> intersect_quad(const Surface& s, const Ray& ray) {
  if (ray.direction.z >= 0) return {};
  SurfacePoint p{};
  p.t = -ray.origin.z / ray.direction.z;
  if (!(p.t > 0)) return {};
  p.position = ray.origin + ray.direction * p.t;
  const double across = p.position.x / s.size_x + 0.5, along = p.position.y / s.size_y + 0.5;
  if (across < 0 || across >= 1 || along <= 0 || along > 1) return {};  // as texels: left and top sides belong to it
  p.tangent = {1, 0, 0}, p.bitangent = {0, 1, 0}, p.normal = p.frame_normal = {0, 0, 1};
  p.u = across * s.repeat_u, p.v = along * s.repeat_v;
  differentiate(ray, p.normal, {s.repeat_u / s.size_x, 0, 0}, {0, s.repeat_v / s.size_y, 0}, p);
  return p;
}

std::optional<SurfacePoint> intersect_sphere(const Surface& s, const Ray& ray) {
  const double length2 = dot(ray.direction, ray.direction);
  const double middle = -dot(ray.origin, ray.direction) / length2;  // t of the point nearest to the centre
  const Vec3d nearest = ray.origin + ray.direction * middle;
  const double depth2 = s.radius * s.radius - dot(nearest, nearest);
  if (!(depth2 > 0)) return {};
  SurfacePoint p{};
  p.t = middle - std::sqrt(depth2 / length2);
  if (!(p.t > 0)) return {};
  p.position = ray.origin + ray.direction * p.t;
  p.normal = p.frame_normal = normalized(p.position);
  const Vec3d n = p.normal;
  const double equator = portable::hypot(n.x, n.z);  // cos φ; 0 at the poles, where the frame takes λ = 0
  p.tangent = equator > 0 ? Vec3d{n.z / equator, 0, -n.x / equator} : Vec3d{1, 0, 0};
  p.bitangent = cross(n, p.tangent);
  p.u = 0.5 + portable::atan2(n.x, n.z) / (2 * kPi);
  p.v = 0.5 + portable::atan2(n.y, equator) / kPi;
  constexpr double kPole = 1e-12;  // keeps the gradient finite; the footprint is beyond any map there
  differentiate(ray, n, p.tangent / (2 * kPi * s.radius * std::max(equator, kPole)), p.bitangent / (kPi * s.radius), p);
  return p;
}

}  // namespace

const char* name(SurfaceType type) {
  static const char* const names[] = {"quad", "sphere", "torus", "mesh"};
  return names[int(type)];
}

void differentiate(const Ray& ray, Vec3d normal, Vec3d gradient_u, Vec3d gradient_v, SurfacePoint& p) {
  const double facing = dot(ray.direction, normal);
  const auto moved = [&](Vec3d dorigin, Vec3d ddirection) {
    const Vec3d d = dorigin + ddirection * p.t;
    return d - ray.direction * (dot(d, normal) / facing);
  };
  const Vec3d dx = moved(ray.dorigin_dx, ray.ddirection_dx), dy = moved(ray.dorigin_dy, ray.ddirection_dy);
  p.du_dx = dot(gradient_u, dx), p.dv_dx = dot(gradient_v, dx);
  p.du_dy = dot(gradient_u, dy), p.dv_dy = dot(gradient_v, dy);
}

std::optional<SurfacePoint> intersect(const Surface& surface, const Ray& ray) {
  if (surface.type == SurfaceType::kTorus) return intersect_torus(surface, ray);
  return surface.type == SurfaceType::kQuad ? intersect_quad(surface, ray) : intersect_sphere(surface, ray);
}

}  // namespace burnish
