// Where an object stands in the world: it is stretched along its own axes, turned, and moved.
//
// Normals are not directions: they stay perpendicular to the surface, and so go by the inverse of the stretch.
#pragma once

#include "burnish/core/portable_math.h"
#include "burnish/core/vec3.h"

namespace burnish {

// Columns are the images of the axes; orthonormal and right-handed.
struct Rotation {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3d apply(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d inverse(Vec3d v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

// About a unit axis, counter-clockwise seen from its tip (Rodrigues).
inline Rotation rotation_about(Vec3d axis, double angle_rad) {
  const double c = portable::cos(angle_rad), s = portable::sin(angle_rad);
  const auto turned = [&](Vec3d v) { return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)); };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

// About x first, then y, then z, all of them axes of the world.
inline Rotation rotation_xyz(Vec3d angles_rad) {
  const Rotation rx = rotation_about({1, 0, 0}, angles_rad.x), ry = rotation_about({0, 1, 0}, angles_rad.y),
                 rz = rotation_about({0, 0, 1}, angles_rad.z);
  const auto turned = [&](Vec3d v) { return rz.apply(ry.apply(rx.apply(v))); };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

// world = rotation · (scale · object) + translation; scale is above 0 along each axis.
struct Transform {
  Rotation rotation;
  Vec3d translation;
  Vec3d scale{1, 1, 1};

  Vec3d point_to_world(Vec3d p) const { return rotation.apply(p * scale) + translation; }
  Vec3d point_to_object(Vec3d p) const { return direction_to_object(p - translation); }
  Vec3d direction_to_world(Vec3d d) const { return rotation.apply(d * scale); }
  Vec3d direction_to_object(Vec3d d) const { return divided(rotation.inverse(d)); }
  // A normal of any length, as a unit vector, stretched but not turned yet.
  Vec3d stretched_normal(Vec3d n) const { return normalized(divided(n)); }
  Vec3d normal_to_world(Vec3d n) const { return rotation.apply(stretched_normal(n)); }

 private:
  Vec3d divided(Vec3d v) const { return {v.x / scale.x, v.y / scale.y, v.z / scale.z}; }
};

}  // namespace burnish
