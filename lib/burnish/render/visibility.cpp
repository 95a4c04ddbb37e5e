#include "burnish/render/visibility.h"

#include <limits>

namespace burnish {

std::optional<Seen> nearest_point(const FrameSetup& setup, const Ray& ray) {
  std::optional<Seen> seen;
  for (std::size_t i = 0; i < setup.scene.objects.size(); i++) {
    const Object& object = setup.scene.objects[i];
    const Transform& m = object.transform;
    const Ray local{m.point_to_object(ray.origin),
                    m.direction_to_object(ray.direction),
                    m.direction_to_object(ray.dorigin_dx),
                    m.direction_to_object(ray.dorigin_dy),
                    m.direction_to_object(ray.ddirection_dx),
                    m.direction_to_object(ray.ddirection_dy)};
    const MeshSurface* mesh = setup.assets[i].mesh.get();
    const std::optional<SurfacePoint> point = mesh ? mesh->intersect(local) : intersect(object.surface, local);
    if (point && (!seen || point->t < seen->point.t)) seen = Seen{i, *point};
  }
  return seen;
}

Arriving arriving_at(const FrameSetup& setup, const Light& light, Vec3d point) {
  Arriving out = arriving(light, point);
  if (!setup.scene.shadows) return out;
  const double distance =
      light.type == LightType::kPoint ? length(light.position - point) : std::numeric_limits<double>::infinity();
  const std::optional<Seen> blocker = nearest_point(setup, {point, out.direction, {}, {}, {}, {}});
  if (blocker && blocker->point.t < distance) out.colour = {};
  return out;
}

}  // namespace burnish
