#include "burnish/render/anisotropy/reflectance_path.h"
#include "burnish/render/ptm/ptm_path.h"
#include "burnish/render/visibility.h"

namespace burnish {
namespace {

class AnalyticPath final : public ShadingPath {
 public:
  explicit AnalyticPath(const FrameSetup& setup) : setup_(setup), reflectance_(setup), ptm_(setup) {}

  Vec3d shade(std::size_t object, const SurfacePoint& point) const override {
    if (setup_.scene.objects[object].reflectance) return reflectance_.shade(object, point);
    if (setup_.scene.objects[object].ptm) return ptm_.shade(object, point);
    const Object& o = setup_.scene.objects[object];
    const Vec3d position = o.transform.point_to_world(point.position);
    std::vector<Arriving> lights;
    for (const Light& light : setup_.lights) lights.push_back(arriving_at(setup_, light, position));
    const Illumination in{lights, setup_.scene.ambient, setup_.camera.to_viewer(position)};
    const Shaded shaded = material(object, point).shade(o.transform.normal_to_world(normal(object, point)), in);
    return blend(o.base.blend, base_sample(o, setup_.assets[object], point, Filter::kNearest).colour, shaded);
  }

  LookedUp look_up(std::size_t object, const SurfacePoint& point) const override {
    if (setup_.scene.objects[object].reflectance) return reflectance_.look_up(object, point);
    if (setup_.scene.objects[object].ptm) return ptm_.look_up(object, point);
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
    if (assets.normals.empty()) return point.normal;
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
  AnalyticReflectance reflectance_;  // of the objects that have one
  AnalyticPtm ptm_;                  // likewise
};

}  // namespace

std::unique_ptr<ShadingPath> make_analytic_path(const FrameSetup& setup) {
  return std::make_unique<AnalyticPath>(setup);
}

}  // namespace burnish
