#include "burnish/mesh/files/polygon_mesh.h"

#include <limits>

#include "burnish/core/error.h"
#include "burnish/mesh/files/polygon.h"

namespace burnish {
namespace {

using Corner = PolygonMesh::Corner;

constexpr std::size_t kMostCorners = 10000;  // of a face; cutting ears off takes the square

// The corners of a face without those that repeat the position of the one before.
struct Outline {
  std::vector<Corner> corners;
  std::vector<Vec3d> points;

  void add(const Corner& corner, const Vec3d& point) {
    if (!points.empty() && point == points.back()) return;
    corners.push_back(corner), points.push_back(point);
  }
  void clear() { corners.clear(), points.clear(); }
};

bool has_area(const std::vector<Vec3d>& p, const Corners& t) {
  return length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) > 0;
}

}  // namespace

Mesh to_triangles(PolygonMesh&& in, const std::string& name, std::size_t& dropped) {
  const std::size_t most = std::numeric_limits<std::uint32_t>::max() / 4;  // leaves room for normals of triangles
  if (in.positions.size() > most || in.uvs.size() > most || in.normals.size() > most || in.corners.size() > most)
    throw file_error(ErrorKind::kUnsupported, name, "expected at most " + std::to_string(most) + " corners, got more");
  Mesh mesh;
  mesh.name = name;
  mesh.positions = std::move(in.positions);
  dropped = 0;
  Outline outline;
  std::size_t begin = 0;
  for (const std::size_t end : in.face_ends) {
    outline.clear();
    for (std::size_t i = begin; i < end; i++) outline.add(in.corners[i], mesh.positions[in.corners[i].position]);
    begin = end;
    if (outline.points.size() > kMostCorners)
      throw file_error(ErrorKind::kUnsupported, name,
                       "expected faces of at most " + std::to_string(kMostCorners) + " corners, got one of " +
                           std::to_string(outline.points.size()));
    const std::size_t before = mesh.triangles.size();
    if (outline.points.size() >= 3)
      for (const Corners& t : triangulate(outline.points)) {
        if (!has_area(outline.points, t)) continue;
        const Corner &a = outline.corners[t[0]], &b = outline.corners[t[1]], &c = outline.corners[t[2]];
        mesh.triangles.push_back({a.position, b.position, c.position});
        if (in.has_uvs) mesh.triangle_uvs.push_back({a.uv, b.uv, c.uv});
        if (in.has_normals) mesh.triangle_normals.push_back({a.normal, b.normal, c.normal});
      }
    if (mesh.triangles.size() == before) dropped++;
  }
  if (mesh.triangles.empty())
    throw file_error(ErrorKind::kMalformed, name,
                     dropped ? "expected faces with area, got " + std::to_string(dropped) + " without"
                             : "expected a mesh with faces, got none");
  if (in.has_uvs) mesh.uvs = std::move(in.uvs);
  if (in.has_normals) {
    mesh.normals = std::move(in.normals);
    settle_normals(mesh);
  }
  return mesh;
}

}  // namespace burnish
