#include <chrono>

#include "burnish/core/error.h"
#include "burnish/render/palette_table.h"
#include "burnish/render/shading_path.h"

namespace burnish {
namespace {

void require_shadable(const Scene& scene, const Object& object, const ObjectAssets& assets) {
  if (!assets.indexed)
    throw file_error(ErrorKind::kMalformed, scene.name,
                     "path 'palette' needs an 'indexed_map', and the object with '" + object.normal_map + "' has none");
  if (assets.space == NormalSpace::kTangent && !object.surface.is_flat())
    throw file_error(
        ErrorKind::kMalformed, object.indexed_map,
        std::string("a tangent-space palette can be shaded on a flat surface only, where its frame is the same "
                    "everywhere; a ") +
            name(object.surface.type) + " needs normals in object space");
  if (object.mip != MipMode::kOff && assets.indexed->levels.size() == 1 && assets.indexed->levels[0].texels() > 1)
    throw file_error(ErrorKind::kMalformed, object.indexed_map,
                     "expected a chain of mip levels, as 'mip' asks for, got one level");
}

class PalettePath final : public ShadingPath {
 public:
  explicit PalettePath(const FrameSetup& setup) : setup_(setup) {
    for (std::size_t i = 0; i < setup.assets.size(); i++)
      require_shadable(setup.scene, setup.scene.objects[i], setup.assets[i]);
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < setup.assets.size(); i++) tables_.push_back(table(i));
    table_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  Vec3d shade(std::size_t object, const SurfacePoint& point) const override {
    const double lambda = this->lambda(object, point);
    if (setup_.scene.objects[object].mip != MipMode::kLinear) return colour(object, point, nearest_level(lambda));
    const int finer = int(lambda);
    const double share = lambda - finer;
    if (share == 0) return colour(object, point, finer);
    return colour(object, point, finer) * (1 - share) + colour(object, point, finer + 1) * share;
  }

  LookedUp look_up(std::size_t object, const SurfacePoint& point) const override {
    const Palette& palette = setup_.assets[object].indexed->palette;
    LookedUp out;
    out.level = nearest_level(lambda(object, point));
    const IndexImage& level = setup_.assets[object].indexed->levels[out.level];
    const TexelPosition t = nearest_texel(point.u, point.v, level.width, level.height, addressing(object));
    out.index = *level.at(t.x, t.y);
    out.material = palette.materials[palette.interval_of(out.index)].id;
    out.normal = Vec3d(palette.normals[out.index]);  // the frame of a flat surface is object space itself
    return out;
  }

  double table_ms() const override { return table_ms_; }

 private:
  // Light and view at the object's origin, taken into object space by the inverse of the model transform
  // (section 5, step 1).
  std::vector<Vec3d> table(std::size_t object) const {
    const Transform& transform = setup_.scene.objects[object].transform;
    std::vector<Arriving> lights;
    for (const Light& light : setup_.lights) {
      Arriving a = arriving(light, transform.translation);
      a.direction = transform.direction_to_object(a.direction);
      lights.push_back(a);
    }
    const Vec3d to_viewer = transform.direction_to_object(setup_.camera.to_viewer(transform.translation));
    const ObjectAssets& assets = setup_.assets[object];
    return shade_palette(assets.indexed->palette, assets.interval_materials, setup_.scene.ambient, lights, to_viewer);
  }

  Addressing addressing(std::size_t object) const { return addressing_of(setup_.scene.objects[object].surface); }

  double lambda(std::size_t object, const SurfacePoint& point) const {
    if (setup_.scene.objects[object].mip == MipMode::kOff) return 0;
    const IndexedMap& map = *setup_.assets[object].indexed;
    return mip_lambda(point, map.width(), map.height(), setup_.samples, int(map.levels.size()));
  }

  // Colours are filtered, not indices: as hardware filters what it has looked up in a palette.
  Vec3d colour(std::size_t object, const SurfacePoint& point, int level) const {
    const IndexImage& indices = setup_.assets[object].indexed->levels[level];
    const std::vector<Vec3d>& table = tables_[object];
    if (setup_.scene.objects[object].filter == Filter::kNearest) {
      const TexelPosition t = nearest_texel(point.u, point.v, indices.width, indices.height, addressing(object));
      return table[*indices.at(t.x, t.y)];
    }
    const BilinearTaps taps = bilinear_taps(point.u, point.v, indices.width, indices.height, addressing(object));
    Vec3d sum;
    for (int i = 0; i < 4; i++) sum += table[*indices.at(taps.texel[i].x, taps.texel[i].y)] * taps.weight[i];
    return sum;
  }

  FrameSetup setup_;
  std::vector<std::vector<Vec3d>> tables_;
  double table_ms_ = 0;
};

}  // namespace

std::unique_ptr<ShadingPath> make_palette_path(const FrameSetup& setup) { return std::make_unique<PalettePath>(setup); }

}  // namespace burnish
