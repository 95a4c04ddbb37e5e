// A triangle mesh: positions, normals and texture coordinates, each with indices of its own for every corner.
//
// Corners that share an index share the attribute; two of them on one edge with different texture coordinates make a
// seam. Triangles turn counter-clockwise seen from outside. Object space is right-handed, u runs right and v up.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

struct Vec2d {
  double x = 0, y = 0;
  friend Vec2d operator+(Vec2d a, Vec2d b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2d operator-(Vec2d a, Vec2d b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2d operator*(Vec2d a, double s) { return {a.x * s, a.y * s}; }
  friend bool operator==(const Vec2d&, const Vec2d&) = default;
};

inline double dot(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
// Twice the signed area of the parallelogram's half: positive where b lies counter-clockwise of a.
inline double cross(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

using Corners = std::array<std::uint32_t, 3>;

struct Mesh {
  std::string name;  // of the file, for messages
  std::vector<Vec3d> positions;
  std::vector<Vec3d> normals;  // unit
  std::vector<Vec2d> uvs;
  std::vector<Corners> triangles;         // into positions
  std::vector<Corners> triangle_normals;  // into normals; one a triangle, or none at all
  std::vector<Corners> triangle_uvs;      // into uvs; one a triangle, or none at all

  bool has_normals() const { return !triangle_normals.empty(); }
  bool has_uvs() const { return !triangle_uvs.empty(); }

  Vec3d position(std::size_t triangle, int corner) const { return positions[triangles[triangle][corner]]; }
  Vec3d normal(std::size_t triangle, int corner) const { return normals[triangle_normals[triangle][corner]]; }
  Vec2d uv(std::size_t triangle, int corner) const { return uvs[triangle_uvs[triangle][corner]]; }

  // Perpendicular to the triangle, outwards; its length is twice the area, 0 of a degenerate one.
  Vec3d perpendicular(std::size_t triangle) const {
    return cross(position(triangle, 1) - position(triangle, 0), position(triangle, 2) - position(triangle, 0));
  }
};

// A place on a mesh: weights of the triangle's corners, which sum to 1.
struct MeshPoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weight{1, 0, 0};
};

// What the corners hold, interpolated. Shading normals are renormalised; a zero sum takes the triangle's own.
Vec3d position_at(const Mesh& mesh, const MeshPoint& point);
Vec3d normal_at(const Mesh& mesh, const MeshPoint& point);
Vec2d uv_at(const Mesh& mesh, const MeshPoint& point);

// Gives a mesh smooth normals where it has none: at each position the triangles' normals weighted by the angle at the
// corner (Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998). Positions that coincide count
// as one. Where they cancel out, as of a card with two sides, each triangle keeps its own. Does nothing where there are
// normals.
void add_smooth_normals(Mesh& mesh);

// Makes normals of any length unit. Corners whose normal has none take the triangle's own; (0,0,1) where that has none
// either.
void settle_normals(Mesh& mesh);

struct Bounds {
  Vec3d least, most;
  Vec3d centre() const { return (least + most) * 0.5; }
  double diagonal() const { return length(most - least); }
};
Bounds bounds(const Mesh& mesh);

// kMalformed where the mesh has no texture coordinates; `why` says what needs them and what to do.
void require_uvs(const Mesh& mesh, const std::string& why);
// kMalformed unless every used texture coordinate lies in [0,1]: the map is an atlas, whose texels each belong to one
// place.
void require_atlas(const Mesh& mesh);

}  // namespace burnish
