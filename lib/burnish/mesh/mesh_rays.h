// Where rays meet a mesh, and which of its points is nearest: an acceleration structure over the triangles.
//
// Embree (single precision) finds the triangle; where on it follows in double precision. Built by one thread and asked
// on one fixed instruction set, so that the answers are the same on every machine and any number of threads. The only
// user of Embree.
#pragma once

#include <memory>
#include <optional>

#include "burnish/mesh/mesh.h"

namespace burnish {

struct RayHit {
  MeshPoint point;
  double t = 0;  // position = origin + t · direction
};

// Which triangles a ray meets: those it comes to from outside, from inside, or all.
enum class Facing { kEither, kFront, kBack };

// kMalformed where a corner of a triangle lies 1e18 or more from the mesh's centre: single precision holds no squares
// of such lengths. Positions that no triangle has do not matter.
void require_traceable(const Mesh& mesh);

class MeshRays {
 public:
  // Keeps positions and triangles of its own. Triangles without area are neither met nor near. Errors as
  // require_traceable.
  explicit MeshRays(const Mesh& mesh);
  ~MeshRays();
  MeshRays(MeshRays&&) noexcept;

  // The first hit with least ≤ t ≤ most; the direction has any length. Watertight along shared edges. May be called
  // from many threads.
  std::optional<RayHit> first_hit(Vec3d origin, Vec3d direction, double least, double most,
                                  Facing facing = Facing::kEither) const;
  // The nearest point within `most` on a triangle whose outside faces the half-space of `direction` (any, where that is
  // zero); the smallest triangle index of equally near ones. Without bounds there is one wherever a triangle has area.
  struct Nearest {
    MeshPoint point;
    double distance = 0;
  };
  std::optional<Nearest> nearest(Vec3d from, double most, Vec3d direction = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace burnish
