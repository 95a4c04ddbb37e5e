// The order of entries inside a material: along a Hilbert curve over the octahedral map.
#pragma once

#include <cstdint>

#include "burnish/core/vec3.h"

namespace burnish {

// Position of a unit vector on the curve; vectors close on the curve are close on the sphere.
std::uint64_t curve_position(Vec3f normal);

}  // namespace burnish
