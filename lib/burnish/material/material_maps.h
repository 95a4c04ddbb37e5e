// What a material is baked from: the frame of every texel, and the parameters of its model.
#pragma once

#include <cstddef>
#include <vector>

#include "burnish/core/parameter.h"
#include "burnish/core/vec3.h"
#include "burnish/material/directions/direction_map.h"
#include "burnish/material/material_textures.h"

namespace burnish {

struct MaterialSource {
  MaterialModel model = MaterialModel::kWard;
  ParameterSource alpha_x, alpha_y;  // not of banks
  ParameterSource k_s{1, {}};
  ParameterSource exponent{32, {}};  // N, of blinn-phong only
  // Where the tangent points: a map of directions, or an angle for all, counter-clockwise from +u.
  FileRef directions;
  DirectionCoding direction_coding;
  double angle_rad = 0;
  FileRef normals;  // none: (0,0,1)
  NormalCoding normal_coding;
};

struct MaterialMaps {
  MaterialModel model = MaterialModel::kWard;
  int width = 1, height = 1;
  std::vector<Vec3f> t, n;  // orthonormal; b = n × t
  Parameter alpha_x, alpha_y, k_s, exponent;
  std::size_t degenerate_texels = 0;      // their t is their nearest neighbour's (orthonormal_directions.h)
  std::size_t invalid_normal_texels = 0;  // too short: (0,0,1)
};

// All maps have one size, and the material theirs; without maps it is one texel. Only what the model uses is read. α
// must be above 0, k_s and N at least 0, all finite: kUsage for a number, kMalformed for a map. Errors of
// read_parameter(), read_direction_map(), read_surface_normals() and orthonormalise().
MaterialMaps read_material_maps(const MaterialSource& source);

}  // namespace burnish
