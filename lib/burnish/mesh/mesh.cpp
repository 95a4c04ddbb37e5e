#include "burnish/mesh/mesh.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr double kLeastNormal = 1e-9;  // shorter ones are rounding errors, not directions

}  // namespace

Vec3d position_at(const Mesh& mesh, const MeshPoint& p) {
  return mesh.position(p.triangle, 0) * p.weight[0] + mesh.position(p.triangle, 1) * p.weight[1] +
         mesh.position(p.triangle, 2) * p.weight[2];
}

Vec3d normal_at(const Mesh& mesh, const MeshPoint& p) {
  if (mesh.has_normals()) {
    const Vec3d n = mesh.normal(p.triangle, 0) * p.weight[0] + mesh.normal(p.triangle, 1) * p.weight[1] +
                    mesh.normal(p.triangle, 2) * p.weight[2];
    if (length(n) > kLeastNormal) return normalized(n);
  }
  return normalized(mesh.perpendicular(p.triangle));
}

Vec2d uv_at(const Mesh& mesh, const MeshPoint& p) {
  return mesh.uv(p.triangle, 0) * p.weight[0] + mesh.uv(p.triangle, 1) * p.weight[1] +
         mesh.uv(p.triangle, 2) * p.weight[2];
}

void add_smooth_normals(Mesh& mesh) {
  if (mesh.has_normals()) return;
  const std::vector<std::uint32_t> same = weld(mesh.positions);
  std::vector<Vec3d> sum(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    const Vec3d perpendicular = mesh.perpendicular(t);
    if (!(length(perpendicular) > 0)) continue;
    for (int c = 0; c < 3; c++) {
      const Vec3d at = mesh.position(t, c);
      const double angle = angle_rad(mesh.position(t, (c + 1) % 3) - at, mesh.position(t, (c + 2) % 3) - at);
      sum[same[mesh.triangles[t][c]]] += normalized(perpendicular) * angle;
    }
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < sum.size(); i++) mesh.normals[i] = sum[same[i]];
  mesh.triangle_normals = mesh.triangles;
  settle_normals(mesh);
}

void settle_normals(Mesh& mesh) {
  std::vector<bool> missing(mesh.normals.size());
  for (std::size_t i = 0; i < missing.size(); i++) {
    Vec3d& n = mesh.normals[i];
    missing[i] = !(length(n) > kLeastNormal);
    n = missing[i] ? Vec3d{0, 0, 1} : normalized(n);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    const Vec3d perpendicular = mesh.perpendicular(t);
    const std::uint32_t own = std::uint32_t(mesh.normals.size());
    bool taken = false;
    for (std::uint32_t& i : mesh.triangle_normals[t])
      if (missing[i] && length(perpendicular) > 0) i = own, taken = true;
    if (taken) mesh.normals.push_back(normalized(perpendicular)), missing.push_back(false);
  }
}

Bounds bounds(const Mesh& mesh) {
  Bounds b{mesh.position(0, 0), mesh.position(0, 0)};
  for (const Corners& triangle : mesh.triangles)
    for (std::uint32_t i : triangle) {
      const Vec3d p = mesh.positions[i];
      b.least = {std::min(b.least.x, p.x), std::min(b.least.y, p.y), std::min(b.least.z, p.z)};
      b.most = {std::max(b.most.x, p.x), std::max(b.most.y, p.y), std::max(b.most.z, p.z)};
    }
  return b;
}

void require_uvs(const Mesh& mesh, const std::string& why) {
  if (!mesh.has_uvs())
    throw file_error(ErrorKind::kMalformed, mesh.name, "expected texture coordinates, " + why + ", got none");
}

void require_atlas(const Mesh& mesh) {
  for (const Corners& triangle : mesh.triangle_uvs)
    for (std::uint32_t i : triangle) {
      const Vec2d uv = mesh.uvs[i];
      if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1))
        throw file_error(ErrorKind::kMalformed, mesh.name,
                         "expected texture coordinates in [0,1], got (" + std::to_string(uv.x) + ", " +
                             std::to_string(uv.y) + ") (burnish-simplify --atlas --new-atlas makes others)");
    }
}

}  // namespace burnish
