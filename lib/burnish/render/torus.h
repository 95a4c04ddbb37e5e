// A ring around z, R its radius and r that of its tube:
//
//   p = ((R + r cos φ) cos λ, (R + r cos φ) sin λ, r sin φ),   u = λ/2π, v = φ/2π
//
// A ray meets it where (p² + R² − r²)² = 4R² (x² + y²), a polynomial of the fourth degree in the ray's parameter.
#pragma once

#include <optional>

#include "burnish/render/surface.h"

namespace burnish {

// The nearest point at t > 0 where the ray enters it.
std::optional<SurfacePoint> intersect_torus(const Surface& surface, const Ray& ray);

}  // namespace burnish
