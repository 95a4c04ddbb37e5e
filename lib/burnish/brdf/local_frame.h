// The frame that a surface reflects in: tangent along the direction of anisotropy, bitangent, normal.
#pragma once

#include <optional>

#include "burnish/core/vec3.h"

namespace burnish {

struct LocalFrame {
  Vec3d t, b, n;  // orthonormal and right-handed: b = n × t
};

// Gram and Schmidt (Isidoro & Brennan: T_new = (T − (N·T) N) / ‖…‖). Neither need have unit length. None where one has
// no length, or T is parallel to N: where less than a part in 10⁶ of it is left.
inline std::optional<LocalFrame> orthonormal_frame(Vec3d n, Vec3d t) {
  const double n_length = length(n), t_length = length(t);
  if (!(n_length > 0 && t_length > 0)) return std::nullopt;
  const Vec3d normal = n * (1 / n_length), direction = t * (1 / t_length);
  const Vec3d left = direction - normal * dot(normal, direction);
  if (!(length(left) > 1e-6)) return std::nullopt;
  // Once more, for what rounding leaves where T is nearly parallel to N.
  const Vec3d tangent = normalized(normalized(left) - normal * dot(normal, normalized(left)));
  return LocalFrame{tangent, cross(normal, tangent), normal};
}

}  // namespace burnish
