// The unbaked maps of a reflectance in memory: what its formula is evaluated from, texel by texel.
#pragma once

#include <vector>

#include "burnish/brdf/local_frame.h"
#include "burnish/render/anisotropy/reflectance.h"

namespace burnish {

struct ReflectanceMaps {
  MaterialMaps material;          // of strands: the frames alone
  std::vector<Vec3f> directions;  // of strands: unit, as they are before they are made orthogonal to the normals, or 0
  bool bumpy = false;             // there is a map of normals

  std::size_t texel(int x, int y) const { return std::size_t(y) * material.width + x; }
  // Orthonormal in double precision.
  LocalFrame frame(std::size_t i) const { return *orthonormal_frame(Vec3d(material.n[i]), Vec3d(material.t[i])); }
};

// Errors of read_material_maps().
ReflectanceMaps read_reflectance_maps(const Reflectance& reflectance);

}  // namespace burnish
