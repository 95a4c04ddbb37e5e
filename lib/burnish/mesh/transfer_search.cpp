#include "burnish/mesh/transfer_search.h"

#include <algorithm>

namespace burnish {

// Rays are traced in single precision.
DetailSearch::DetailSearch(const Mesh& detailed, const TransferReach& reach)
    : mesh_(detailed), rays_(detailed), reach_(reach), touch_(1e-6 * bounds(detailed).diagonal()) {}

std::optional<RayHit> DetailSearch::facing_hit(Vec3d position, Vec3d ray, Vec3d direction, double most) const {
  const Vec3d origin = position - ray * touch_;
  for (double from = 0; from <= most + touch_;) {
    std::optional<RayHit> hit = rays_.first_hit(origin, ray, from, most + touch_);
    if (!hit) return {};
    if (dot(mesh_.perpendicular(hit->point.triangle), direction) > 0) {
      hit->t -= touch_;
      return hit;
    }
    from = std::max(from, hit->t) + touch_;
  }
  return {};
}

std::optional<Detail> DetailSearch::find(Vec3d position, Vec3d direction) const {
  std::optional<RayHit> best = facing_hit(position, direction, direction, reach_.cage);
  const double nearer = best ? std::min(best->t, reach_.max_distance) : reach_.max_distance;
  if (const auto inwards = facing_hit(position, -direction, direction, nearer)) best = inwards;
  std::optional<MeshPoint> point;
  if (best) {
    point = best->point;
  } else if (const auto nearest = rays_.nearest(position, reach_.max_distance);
             nearest && dot(normal_at(mesh_, nearest->point), direction) > 0) {
    point = nearest->point;
  }
  if (!point) return {};
  return Detail{*point, position_at(mesh_, *point) - position};
}

}  // namespace burnish
