// Which point of a detailed mesh belongs to a point of a coarse one.
//
// Along a direction near the coarse mesh's normal, outwards up to `cage` and inwards up to `max_distance`, the nearest
// hit on a triangle that faces the same half-space. Triangles that face the other way are the far sides of thin walls
// and are passed over. Where no ray hits, as at rims, the nearest point within `max_distance` on a triangle that
// passes the same test.
#pragma once

#include <optional>

#include "burnish/mesh/mesh_rays.h"

namespace burnish {

struct TransferReach {
  double max_distance = 0;
  double cage = 0;
};

struct Detail {
  MeshPoint point;      // of the detailed mesh
  Vec3d offset;         // from the place of the search to it
  double distance = 0;  // the length of that, never beyond the reach
};

class DetailSearch {
 public:
  // The detailed mesh has normals and is kept by reference.
  DetailSearch(const Mesh& detailed, const TransferReach& reach);

  // `direction` is of unit length and points outwards. May be called from many threads.
  std::optional<Detail> find(Vec3d position, Vec3d direction) const;

 private:
  // Its distance is negative by rounding where the surfaces touch.
  std::optional<RayHit> hit(Vec3d position, Vec3d ray, double most, Facing facing) const;

  // None where the point lies farther off than `most`, as single precision tells, in which rays are traced: rounding
  // leaves no holes in a surface at the limit.
  std::optional<Detail> within(double most, Vec3d position, const MeshPoint& point) const;

  const Mesh& mesh_;
  MeshRays rays_;
  TransferReach reach_;
  double touch_;  // what counts as no distance
};

}  // namespace burnish
