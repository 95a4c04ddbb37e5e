#include "burnish/render/mesh_surface.h"

#include <limits>
#include <utility>

namespace burnish {
namespace {

Mesh with_normals(Mesh mesh, MeshShading shading) {
  if (shading == MeshShading::kFlat) {
    mesh.normals.clear(), mesh.triangle_normals.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); t++) {
      const Vec3d n = mesh.perpendicular(t);
      mesh.normals.push_back(length(n) > 0 ? normalized(n) : Vec3d{0, 0, 1});
      mesh.triangle_normals.push_back({t, t, t});
    }
  }
  add_smooth_normals(mesh);
  return mesh;
}

}  // namespace

MeshSurface::MeshSurface(Mesh mesh, MeshShading shading) : mesh_(with_normals(std::move(mesh), shading)), rays_(mesh_) {
  if (mesh_.has_uvs()) frames_ = tangent_frames(mesh_);
}

std::optional<SurfacePoint> MeshSurface::intersect(const Ray& ray) const {
  const std::optional<RayHit> hit =
      rays_.first_hit(ray.origin, ray.direction, 0, std::numeric_limits<double>::max(), Facing::kFront);
  if (!hit) return {};
  SurfacePoint p{};
  p.t = hit->t;
  p.position = position_at(mesh_, hit->point);
  p.normal = normal_at(mesh_, hit->point);
  if (!mesh_.has_uvs()) return p;
  const FrameAt frame = frame_at(mesh_, frames_, hit->point);
  p.tangent = frame.t, p.bitangent = frame.b, p.frame_normal = frame.n;
  const Vec2d uv = uv_at(mesh_, hit->point);
  p.u = uv.x, p.v = uv.y;

  // u and v are linear over the triangle: their gradients g solve g·e₁ = Δu₁, g·e₂ = Δu₂ within its plane.
  const std::uint32_t t = hit->point.triangle;
  const Vec3d e1 = mesh_.position(t, 1) - mesh_.position(t, 0), e2 = mesh_.position(t, 2) - mesh_.position(t, 0),
              n = cross(e1, e2);
  const Vec2d d1 = mesh_.uv(t, 1) - mesh_.uv(t, 0), d2 = mesh_.uv(t, 2) - mesh_.uv(t, 0);
  const Vec3d a = cross(e2, n) / dot(n, n), b = cross(n, e1) / dot(n, n);
  differentiate(ray, n, a * d1.x + b * d2.x, a * d1.y + b * d2.y, p);
  return p;
}

}  // namespace burnish
