#include "burnish/mesh/bake/transfer_search.h"

#include <algorithm>

namespace burnish {

// Rays are traced in single precision.
DetailSearch::DetailSearch(const Mesh& detailed, const TransferReach& reach)
    : mesh_(detailed), rays_(detailed), reach_(reach), touch_(1e-6 * bounds(detailed).diagonal()) {}

std::optional<RayHit> DetailSearch::hit(Vec3d position, Vec3d ray, double most, Facing facing) const {
  std::optional<RayHit> hit = rays_.first_hit(position - ray * touch_, ray, 0, most + touch_, facing);
  if (hit) hit->t -= touch_;
  return hit;
}

std::optional<Detail> DetailSearch::within(double most, Vec3d position, const MeshPoint& point) const {
  const Vec3d offset = position_at(mesh_, point) - position;
  const double distance = length(offset);
  if (float(distance) > float(most) && distance > touch_) return {};
  return Detail{point, offset, std::min(distance, most)};
}

std::optional<Detail> DetailSearch::find(Vec3d position, Vec3d direction) const {
  std::optional<Detail> best;
  double nearer = reach_.max_distance;
  if (const auto outwards = hit(position, direction, reach_.cage, Facing::kBack)) {
    best = within(reach_.cage, position, outwards->point);
    if (best) nearer = std::min(nearer, outwards->t);
  }
  if (const auto inwards = hit(position, -direction, nearer, Facing::kFront))
    if (const auto detail = within(reach_.max_distance, position, inwards->point)) best = detail;
  if (best) return best;
  if (const auto nearest = rays_.nearest(position, reach_.max_distance, direction))
    return within(reach_.max_distance, position, nearest->point);
  return {};
}

}  // namespace burnish
