// A mesh as a surface to shade: where a ray meets it, and what is known there.
//
// Normals are interpolated from the file's, or smooth ones where it has none; shaded flat, they are the triangles' own.
// The tangent frame is MikkTSpace's, interpolated and not renormalised, as burnish-transfer bakes against. Without
// texture coordinates all texture lookups are at (0, 0).
#pragma once

#include <optional>

#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/tangent_frames.h"
#include "burnish/render/surface.h"

namespace burnish {

enum class MeshShading { kSmooth, kFlat };

class MeshSurface {
 public:
  MeshSurface(Mesh mesh, MeshShading shading);

  // The nearest point at t > 0 that is seen from outside; the ray is given in object space. From many threads.
  std::optional<SurfacePoint> intersect(const Ray& ray) const;

 private:
  Mesh mesh_;
  MeshRays rays_;
  TangentFrames frames_;  // none where the mesh has no texture coordinates
};

}  // namespace burnish
