// The surfaces that maps are laid on, in object space: where a ray meets them, and what is known there.
//
// quad    in the plane z = 0 around the origin, size.x by size.y; u along +x, v along +y, normal +z; flat:
// the tangent frame is
//         that of object space everywhere.
// sphere  around the origin; latitude and longitude, v up (+y), u = ½ facing +z and growing towards +x:
//         p = r·(sin λ cos φ, sin φ, cos λ cos φ), u = ½ + λ/2π, v = ½ + φ/π.
// torus   around the axis z: see torus.h.
// mesh    triangles of a file, whose outside is where their corners turn counter-clockwise: see mesh_surface.h.
// Only the outside is there: a ray that comes from behind passes through.
#pragma once

#include <optional>

#include "burnish/core/vec3.h"
#include "burnish/render/camera.h"

namespace burnish {

enum class SurfaceType { kQuad, kSphere, kTorus, kMesh };
const char* name(SurfaceType type);  // "quad", "sphere", "torus", "mesh"

struct Surface {
  SurfaceType type = SurfaceType::kQuad;
  double size_x = 1, size_y = 1;      // quad
  double radius = 0.5;                // sphere; of a torus its ring
  double tube_radius = 0.15;          // torus
  double repeat_u = 1, repeat_v = 1;  // quad: how often the map is repeated along its sides

  // Whether the tangent frame is the same everywhere, and object space itself.
  bool is_flat() const { return type == SurfaceType::kQuad; }
};

struct SurfacePoint {
  double t;                                // of the ray
  Vec3d position;                          // object space
  Vec3d normal;                            // unit, outwards; of a mesh the shading normal
  Vec3d tangent, bitangent, frame_normal;  // the tangent frame, along +u, +v and outwards; of a mesh not unit
  double u, v;                             // texture coordinates
  double du_dx, dv_dx, du_dy,
      dv_dy;  // change per pixel, on the tangent plane (Igehy, "Tracing ray differentials", 1999)

  // Of any length.
  Vec3d tangent_to_object(Vec3d n) const { return tangent * n.x + bitangent * n.y + frame_normal * n.z; }
};

// The nearest point at t > 0 that is seen from outside; the ray is given in object space.
// For all but meshes.
std::optional<SurfacePoint> intersect(const Surface& surface, const Ray& ray);

// Fills the derivatives from the gradients of u and v over object space, which lie in the plane across `normal`.
void differentiate(const Ray& ray, Vec3d normal, Vec3d gradient_u, Vec3d gradient_v, SurfacePoint& point);

}  // namespace burnish
