#include "burnish/render/anisotropy/local_view.h"

#include "burnish/brdf/local_frame.h"
#include "burnish/render/visibility.h"

namespace burnish {
namespace {

// The surface's frame in the world. Where texture coordinates give no direction, any will do.
LocalFrame surface_frame(const Transform& m, const SurfacePoint& point) {
  const Vec3d n = m.normal_to_world(point.frame_normal), t = m.direction_to_world(point.tangent);
  const auto frame = orthonormal_frame(n, t);
  if (!frame) return *orthonormal_frame(n, std::abs(n.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
  LocalFrame out = *frame;
  if (dot(out.b, m.direction_to_world(point.bitangent)) < 0) out.b = -out.b;  // mirrored texture coordinates
  return out;
}

}  // namespace

LocalView local_view(const FrameSetup& setup, std::size_t object, const SurfacePoint& point) {
  const Transform& m = setup.scene.objects[object].transform;
  const Vec3d position = m.point_to_world(point.position);
  const LocalFrame frame = surface_frame(m, point);
  const auto local = [&](Vec3d d) { return Vec3d{dot(d, frame.t), dot(d, frame.b), dot(d, frame.n)}; };
  LocalView view{local(setup.camera.to_viewer(position)), {}};
  for (const Light& light : setup.lights) {
    const Arriving at = arriving_at(setup, light, position);
    view.lights.push_back({local(at.direction), at.colour});
  }
  return view;
}

}  // namespace burnish
