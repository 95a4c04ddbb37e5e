// Meshes for tests, from closed forms: grids over (u, v) that are bent into a shape and mapped onto a texture.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "burnish/mesh/mesh.h"

namespace burnish {

using GridPosition = std::function<Vec3d(double u, double v)>;
using GridUv = std::function<Vec2d(double u, double v)>;

// (u, v) runs over [0,1]²; u to the right and v up turn counter-clockwise seen from outside. No vertex is shared where
// ends meet, as in many files: positions there are equal, and indices are not. Triangles without area are left out.
inline Mesh grid_mesh(int columns, int rows, const GridPosition& position, const GridUv& uv) {
  Mesh mesh;
  mesh.name = "grid";
  for (int j = 0; j <= rows; j++)
    for (int i = 0; i <= columns; i++) {
      const double u = double(i) / columns, v = double(j) / rows;
      mesh.positions.push_back(position(u, v));
      mesh.uvs.push_back(uv(u, v));
    }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3d pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    if (pa == pb || pb == pc || pc == pa) return;
    mesh.triangles.push_back({a, b, c});
    mesh.triangle_uvs.push_back({a, b, c});
  };
  for (int j = 0; j < rows; j++)
    for (int i = 0; i < columns; i++) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
      // Diagonals alternate, so that no direction is preferred.
      if ((i + j) % 2) add(a, b, c), add(a, c, d);
      else add(a, b, d), add(b, c, d);
    }
  return mesh;
}

inline Vec2d identity_uv(double u, double v) { return {u, v}; }
// The right half of the texture is the left half seen in a mirror.
inline Vec2d mirrored_uv(double u, double v) { return {2 * std::min(u, 1 - u), v}; }
// Neither along the axes nor of one scale.
inline Vec2d turned_uv(double u, double v) { return {0.3 + 0.4 * u - 0.2 * v, 0.2 + 0.2 * u + 0.5 * v}; }

// Exactly periodic, whatever the machine's sine makes of 2π.
inline Vec2d circle(double turn) {
  const double t = turn >= 1 ? 0 : turn;
  return {std::cos(2 * kPi * t), std::sin(2 * kPi * t)};
}
inline Vec3d unit_sphere(double u, double v) {
  if (v <= 0 || v >= 1) return {0, v <= 0 ? -1.0 : 1.0, 0};
  const Vec2d c = circle(u);
  return {std::sin(kPi * v) * c.y, -std::cos(kPi * v), std::sin(kPi * v) * c.x};
}
inline Vec3d torus(double u, double v) {
  const Vec2d a = circle(u), b = circle(v);
  const double r = 1 + 0.4 * b.x;
  return {r * a.y, 0.4 * b.y, r * a.x};
}
inline Vec3d bumpy_sphere(double u, double v) {
  const Vec3d p = unit_sphere(u, v);
  return p * (1 + 0.03 * std::sin(14 * p.x + 3 * p.y) * std::cos(13 * p.y - 4 * p.z) * std::cos(12 * p.z));
}
inline Vec3d bumpy_sheet(double u, double v) {
  return {u, v, 0.1 * std::sin(7 * u + 2 * v) * std::cos(5 * v - 3 * u * u)};
}

// Four charts: the texture of each quadrant is turned by a quarter more, so that it jumps where they meet.
inline Mesh split_uvs(Mesh mesh) {
  const std::uint32_t count = std::uint32_t(mesh.uvs.size());
  for (int turns = 1; turns < 4; turns++)
    for (std::uint32_t i = 0; i < count; i++) {
      const Vec2d t = mesh.uvs[i + (turns - 1) * count];
      mesh.uvs.push_back({1 - t.y, t.x});
    }
  for (Corners& t : mesh.triangle_uvs) {
    const Vec2d sum = mesh.uvs[t[0]] + mesh.uvs[t[1]] + mesh.uvs[t[2]];
    const std::uint32_t chart = (sum.x > 1.5) + 2 * (sum.y > 1.5);
    for (std::uint32_t& i : t) i += chart * count;
  }
  return mesh;
}

// By name, for the command-line tests; n is about the number of rows.
inline Mesh named_mesh(const std::string& name, int n) {
  static const std::map<std::string, std::function<Mesh(int)>> table{
      {"sphere", [](int k) { return grid_mesh(2 * k, k, unit_sphere, identity_uv); }},
      {"bumpy-sphere", [](int k) { return grid_mesh(2 * k, k, bumpy_sphere, identity_uv); }},
      {"mirrored-sphere", [](int k) { return grid_mesh(2 * k, k, unit_sphere, mirrored_uv); }},
      {"torus", [](int k) { return grid_mesh(2 * k, k, torus, identity_uv); }},
      {"mirrored-torus", [](int k) { return grid_mesh(2 * k, k, torus, mirrored_uv); }},
      {"split-torus", [](int k) { return split_uvs(grid_mesh(2 * k, k, torus, identity_uv)); }},
      {"split-mirrored-sphere", [](int k) { return split_uvs(grid_mesh(2 * k, k, unit_sphere, mirrored_uv)); }},
      {"sheet", [](int k) { return grid_mesh(k, k, bumpy_sheet, turned_uv); }},
      {"square-sheet", [](int k) { return grid_mesh(k, k, bumpy_sheet, identity_uv); }},
      {"mirrored-sheet", [](int k) { return grid_mesh(k, k, bumpy_sheet, mirrored_uv); }},
  };
  Mesh mesh = table.at(name)(n);
  mesh.name = name;
  return mesh;
}

// The same without texture coordinates.
inline Mesh without_uvs(Mesh mesh) {
  mesh.uvs.clear(), mesh.triangle_uvs.clear();
  return mesh;
}

// Both in one mesh, as positions and triangles.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh out;
  for (const Mesh* part : {&a, &b}) {
    const std::uint32_t first = std::uint32_t(out.positions.size());
    out.positions.insert(out.positions.end(), part->positions.begin(), part->positions.end());
    for (const Corners& t : part->triangles) out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return out;
}

}  // namespace burnish
