// A polygon to triangles.
#pragma once

#include <span>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

// Indices into the outline, count − 2 triangles, turning as it does. A convex outline becomes the fan from its first
// corner; of others ears are cut off in the plane of their mean normal (Meisters 1975), and what has no ear left, since
// it crosses itself, becomes a fan.
std::vector<Corners> triangulate(std::span<const Vec3d> outline);

}  // namespace burnish
