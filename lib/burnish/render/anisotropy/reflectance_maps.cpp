#include "burnish/render/anisotropy/reflectance_maps.h"

#include "burnish/core/portable_math.h"

namespace burnish {

ReflectanceMaps read_reflectance_maps(const Reflectance& r) {
  ReflectanceMaps out;
  out.material = read_material_maps(r.source);
  out.bumpy = !r.source.normals.empty();
  if (!r.is_strand()) return out;
  if (r.source.directions.empty()) {
    const Vec3d t{portable::cos(r.source.angle_rad), portable::sin(r.source.angle_rad), 0};
    out.directions.assign(out.material.t.size(), Vec3f(t));
  } else {
    out.directions = read_direction_map(r.source.directions, r.source.direction_coding).vectors;
    for (Vec3f& t : out.directions) t = length(t) > 0 ? normalized(t) : t;
  }
  return out;
}

}  // namespace burnish
