// Reads a measured reflectance and asks it for some.
#pragma once

#include "burnish/brdf/measured/measured_brdf.h"

namespace burnish::fuzz {

inline void ask(const Brdf& brdf) {
  brdf.reflected({0, 0, 1}, normalized(Vec3d{0.3, -0.2, 0.6}));
  brdf.reflected(normalized(Vec3d{1, 0, 1e-6}), normalized(Vec3d{-1, 1e-6, 1e-6}));
}

inline void read_measured_surface(const FileRef& file) { ask(*read_measured_brdf(file)); }

}  // namespace burnish::fuzz
