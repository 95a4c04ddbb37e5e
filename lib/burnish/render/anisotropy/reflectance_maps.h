// The unbaked maps of a reflectance in memory: what its formula is evaluated from, texel by texel.
#pragma once

#include <vector>

#include "burnish/brdf/local_frame.h"
#include "burnish/core/image.h"
#include "burnish/normal/coding.h"
#include "burnish/render/anisotropy/reflectance.h"

namespace burnish {

// One channel, or one number for all texels.
struct FieldMap {
  double number = 0;
  std::vector<float> texels;

  double at(std::size_t i) const { return texels.empty() ? number : texels[i]; }
};

struct ReflectanceMaps {
  int width = 1, height = 1;      // of all of them
  std::vector<Vec3f> normals;     // unit, tangent space; empty: (0,0,1)
  std::vector<Vec3f> directions;  // unit, as they were given, or 0; empty: one for all texels
  Vec3f direction{1, 0, 0};
  std::vector<Vec3f> tangents;  // the directions made orthonormal to the normals; empty: `direction`
  FieldMap alpha_x, alpha_y, k_s, exponent;
  std::size_t invalid_normals = 0;  // they became (0,0,1)

  Vec3f normal(std::size_t i) const { return normals.empty() ? Vec3f{0, 0, 1} : normals[i]; }
  Vec3f given_direction(std::size_t i) const { return directions.empty() ? direction : directions[i]; }
  LocalFrame frame(std::size_t i) const {
    const Vec3f t = tangents.empty() ? direction : tangents[i];
    return *orthonormal_frame(Vec3d(normal(i)), Vec3d(t));
  }
};

// `normal_map`: empty for none. kMalformed for maps of other sizes, α of 0 and below, negative k_s, NaN, normals in
// object space, and directions of no length throughout.
ReflectanceMaps read_reflectance_maps(const Reflectance& reflectance, const std::string& normal_map,
                                      const NormalCoding& coding);

}  // namespace burnish
