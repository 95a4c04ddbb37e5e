// What a ray meets among all objects, and whether a light reaches a point.
#pragma once

#include <optional>

#include "burnish/render/shading_path.h"

namespace burnish {

struct Seen {
  std::size_t object = 0;
  SurfacePoint point;
};

// The nearest; the ray is given in the world.
std::optional<Seen> nearest_point(const FrameSetup& setup, const Ray& ray);

// What arrives at a point of the world from a light: black where the scene casts shadows and an object is in between.
// Only outsides are in the way, so that no surface shadows what it is itself lit from.
Arriving arriving_at(const FrameSetup& setup, const Light& light, Vec3d point);

}  // namespace burnish
