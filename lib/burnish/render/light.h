// Lights, and what arrives from them at a point.
#pragma once

#include "burnish/core/vec3.h"
#include "burnish/render/transform.h"

namespace burnish {

enum class LightType { kDirectional, kPoint };
enum class Falloff { kNone, kInverseSquare };

struct Light {
  LightType type = LightType::kDirectional;
  Vec3d direction{0, 0, 1};  // directional: unit, towards the light
  Vec3d position;            // point
  Vec3d colour{1, 1, 1};
  double intensity = 1;
  Falloff falloff = Falloff::kNone;  // point: by distance
};

// Unit direction towards the light and the colour that arrives along it.
struct Arriving {
  Vec3d direction, colour;
};

// At a point of the same space as the light's; a point at the light itself sees it along +z.
inline Arriving arriving(const Light& light, Vec3d point) {
  const Vec3d colour = light.colour * light.intensity;
  if (light.type == LightType::kDirectional) return {light.direction, colour};
  const Vec3d way = light.position - point;
  const double distance = length(way);
  if (!(distance > 0)) return {{0, 0, 1}, colour};
  return {way / distance, light.falloff == Falloff::kNone ? colour : colour / (distance * distance)};
}

// The light turned about an axis through the origin of the world.
inline Light turned(Light light, const Rotation& rotation) {
  light.direction = rotation.apply(light.direction);
  light.position = rotation.apply(light.position);
  return light;
}

}  // namespace burnish
