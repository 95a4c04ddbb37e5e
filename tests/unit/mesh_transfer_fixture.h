// What the tests of the transfer of detail share.
#pragma once

#include <utility>

#include "../mesh_patterns.h"
#include "burnish/mesh/bake/transfer.h"

namespace burnish {

// Faces +z over the unit square; the map's u runs along x, v along y.
inline Mesh square(double z, int n = 1) {
  return grid_mesh(
      n, n,
      [z](double u, double v) {
        return Vec3d{u, v, z};
      },
      identity_uv);
}

inline Mesh facing_down(Mesh mesh) {
  for (Corners& c : mesh.triangles) std::swap(c[1], c[2]);
  return mesh;
}

inline TransferOptions at_size(int width, int height) {
  TransferOptions options;
  options.width = width, options.height = height;
  options.padding = 0;
  return options;
}

inline Vec3d object_normal(const TransferMaps& maps, int x, int y) {
  return Vec3d(maps.normals[std::size_t(y) * maps.width + x]);
}

}  // namespace burnish
