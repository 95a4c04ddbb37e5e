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

std::optional<Detail> DetailSearch::find(Vec3d position, Vec3d direction) const {
  std::optional<RayHit> best = hit(position, direction, reach_.cage, Facing::kBack);
  const double nearer = best ? std::min(best->t, reach_.max_distance) : reach_.max_distance;
  if (const auto inwards = hit(position, -direction, nearer, Facing::kFront)) best = inwards;
  std::optional<MeshPoint> point;
  if (best) point = best->point;
  else if (const auto nearest = rays_.nearest(position, reach_.max_distance, direction)) point = nearest->point;
  if (!point) return {};
  return Detail{*point, position_at(mesh_, *point) - position};
}

}  // namespace burnish
