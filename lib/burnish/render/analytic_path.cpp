#include "burnish/render/shading_path.h"

namespace burnish {
namespace {

class AnalyticPath final : public ShadingPath {
 public:
  explicit AnalyticPath(const FrameSetup& setup) : setup_(setup) {}

  Vec3d shade(std::size_t object, const SurfacePoint& point) const override {
    const Transform& transform = setup_.scene.objects[object].transform;
    const Vec3d position = transform.point_to_world(point.position);
    const Vec3d n = transform.direction_to_world(normal(object, point)), to_viewer = setup_.camera.to_viewer(position);
    return std::visit(
        [&](const auto& model) {
          Vec3d colour = setup_.scene.ambient * model.ambient;
          for (const Light& light : setup_.lights) {
            const Arriving a = arriving(light, position);
            colour += a.colour * model.reflect(n, a.direction, to_viewer);
          }
          return colour;
        },
        material(object, point).model);
  }

  LookedUp look_up(std::size_t object, const SurfacePoint& point) const override {
    LookedUp out;
    out.normal = normal(object, point);
    if (const auto& indexed = setup_.assets[object].indexed) {
      out.index = base_index(object, point);
      out.material = indexed->palette.materials[indexed->palette.interval_of(out.index)].id;
    }
    return out;
  }

 private:
  TexelPosition texel(std::size_t object, const SurfacePoint& point, int width, int height) const {
    return nearest_texel(point.u, point.v, width, height, addressing_of(setup_.scene.objects[object].surface));
  }

  Vec3d normal(std::size_t object, const SurfacePoint& point) const {
    const ObjectAssets& assets = setup_.assets[object];
    const TexelPosition t = texel(object, point, assets.width, assets.height);
    const Vec3d n(assets.normals[std::size_t(t.y) * assets.width + t.x]);
    return assets.space == NormalSpace::kObject ? n : point.tangent_to_object(n);
  }

  int base_index(std::size_t object, const SurfacePoint& point) const {
    const IndexImage& base = setup_.assets[object].indexed->levels[0];
    const TexelPosition t = texel(object, point, base.width, base.height);
    return *base.at(t.x, t.y);
  }

  const Material& material(std::size_t object, const SurfacePoint& point) const {
    const ObjectAssets& assets = setup_.assets[object];
    if (assets.only_material) return *assets.only_material;
    return *assets.interval_materials[assets.indexed->palette.interval_of(base_index(object, point))];
  }

  FrameSetup setup_;
};

}  // namespace

std::unique_ptr<ShadingPath> make_analytic_path(const FrameSetup& setup) {
  return std::make_unique<AnalyticPath>(setup);
}

std::unique_ptr<ShadingPath> make_path(RenderPath path, const FrameSetup& setup) {
  return path == RenderPath::kAnalytic ? make_analytic_path(setup) : make_palette_path(setup);
}

}  // namespace burnish
