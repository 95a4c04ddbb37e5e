// What mesh files hold: polygons, whose corners name a position and, of all or of none, texture coordinates and a
// normal. And the triangles that they become.
#pragma once

#include <string>

#include "burnish/mesh/mesh.h"

namespace burnish {

struct PolygonMesh {
  struct Corner {
    std::uint32_t position = 0, uv = 0, normal = 0;
  };
  std::vector<Vec3d> positions, normals;  // normals of any length
  std::vector<Vec2d> uvs;
  std::vector<Corner> corners;
  std::vector<std::size_t> face_ends;  // into corners
  bool has_uvs = false, has_normals = false;
  std::vector<std::string> left_out;  // as MeshReadStats

  void end_face() { face_ends.push_back(corners.size()); }
  // Where each vertex has texture coordinates and a normal of its own.
  void add_vertex_corner(std::uint32_t vertex) { corners.push_back({vertex, vertex, vertex}); }
};

// Every index of the corners must be there, every number finite. `dropped` counts the faces without area.
// kMalformed where no face has area; kUnsupported for a face of more than 10,000 corners.
Mesh to_triangles(PolygonMesh&& polygons, const std::string& name, std::size_t& dropped);

}  // namespace burnish
