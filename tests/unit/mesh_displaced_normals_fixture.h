// What the tests of displaced normals share.
#pragma once

#include <functional>

#include "../mesh_patterns.h"
#include "burnish/mesh/bake/displaced_normals.h"

namespace burnish {

inline HeightField field_of(int width, int height, const std::function<double(double u, double v)>& value) {
  HeightField field{"h.exr", Image(width, height), {}, false};
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) *field.heights.at(x, y) = float(value((x + 0.5) / width, 1 - (y + 0.5) / height));
  return field;
}

inline double waves(double u, double v) { return std::sin(9 * u + 3 * v) * std::cos(7 * v - 2 * u) + 0.3 * u * v; }

inline HeightMapOptions with_height(double height) {
  HeightMapOptions options;
  options.height = height;
  return options;
}

inline Vec3d normal_of(const DisplacedNormals& map, int x, int y) {
  return Vec3d(map.normals[std::size_t(y) * map.width + x]);
}

// A flat sheet anywhere in space, `a` along u and `b` along v.
inline Mesh sheet(Vec3d a, Vec3d b, const GridUv& uv = identity_uv) {
  return grid_mesh(
      3, 2,
      [&](double u, double v) {
        return Vec3d{4, -1, 2} + a * u + b * v;
      },
      uv);
}
inline const Vec3d kA = Vec3d{1, 2, 2} * 0.7, kB = Vec3d{2, 1, -2} * 0.4;  // lengths 2.1 and 1.2

// u once round a tube of circumference 2, v along its length 1.
inline Mesh tube(int columns) {
  return grid_mesh(
      columns, 4,
      [](double u, double v) {
        const Vec2d c = circle(u);
        return Vec3d{c.x / kPi, c.y / kPi, v};
      },
      identity_uv);
}

}  // namespace burnish
