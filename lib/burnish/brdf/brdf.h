// A homogeneous surface's reflectance, whatever it is known from: a formula or measurements.
#pragma once

#include "burnish/core/vec3.h"

namespace burnish {

class Brdf {
 public:
  virtual ~Brdf() = default;

  // f_r(l, v) (n·l) in 1/sr: red, green and blue that leave towards v per unit of light that falls at a right angle.
  // Unit vectors in the surface's own frame: tangent x, bitangent y, normal z. 0 where light or view is below the
  // surface or on it. From many threads.
  Vec3d reflected(Vec3d l, Vec3d v) const { return l.z > 0 && v.z > 0 ? reflected_above(l, v) : Vec3d{}; }

 private:
  virtual Vec3d reflected_above(Vec3d l, Vec3d v) const = 0;
};

}  // namespace burnish
