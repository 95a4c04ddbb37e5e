#include <chrono>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/render/palette/palette_table.h"
#include "burnish/render/shading_path.h"

namespace burnish {
namespace {

void require_shadable(const Scene& scene, const Object& object, const ObjectAssets& assets, RenderPath path) {
  if (!assets.indexed)
    throw file_error(
        ErrorKind::kMalformed, scene.name,
        std::string("path '") + name(path) + "' needs an 'indexed_map', and " + described(object) + " has none");
  if (scene.shadows)
    throw file_error(ErrorKind::kMalformed, scene.name,
                     std::string("path '") + name(path) + "' knows no shadows, got shadows = 'cast'");
  if (assets.space == NormalSpace::kTangent && !object.surface.is_flat())
    throw file_error(
        ErrorKind::kMalformed, object.indexed_map,
        std::string("a tangent-space palette can be shaded on a flat surface only, where its frame is the same "
                    "everywhere; a ") +
            name(object.surface.type) +
            " needs normals in object space (burnish-quantize --space object, or 'normal_space' where they are "
            "already)");
  if (object.mip != MipMode::kOff && assets.indexed->levels.size() == 1 && assets.indexed->levels[0].texels() > 1)
    throw file_error(ErrorKind::kMalformed, object.indexed_map,
                     "expected a chain of mip levels, as 'mip' asks for, got one level");
}

// One object's colours in this frame.
struct ObjectColours {
  PaletteTable table;
  std::vector<std::vector<std::vector<float>>> expanded;  // of each level, each channel of the table: a colour a texel

  float at(const IndexedMap& map, int level, TexelPosition t, int channel) const {
    const IndexImage& indices = map.levels[level];
    if (!expanded.empty()) return expanded[level][channel][std::size_t(t.y) * indices.width + t.x];
    return table.plane(channel)[*indices.at(t.x, t.y)];
  }
};

class PalettePath final : public ShadingPath {
 public:
  PalettePath(const FrameSetup& setup, bool expanded) : setup_(setup) {
    for (std::size_t i = 0; i < setup.assets.size(); i++) {
      const Object& object = setup.scene.objects[i];
      const ObjectAssets& assets = setup.assets[i];
      require_shadable(setup.scene, object, assets, expanded ? RenderPath::kPaletteExpanded : RenderPath::kPalette);
      colours_.push_back(
          {{assets.indexed->palette, assets.interval_materials, object.transform, object.base.blend}, {}});
    }
    // The first round wakes caches and threads, the second is what a frame costs.
    for (std::size_t i = 0; i < colours_.size(); i++) shade_table(i);
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < colours_.size(); i++) shade_table(i);
    table_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; expanded && i < colours_.size(); i++) expand(i);
  }

  Vec3d shade(std::size_t object, const SurfacePoint& point) const override {
    const Object& o = setup_.scene.objects[object];
    const double lambda = this->lambda(object, point);
    const int finer = o.mip == MipMode::kLinear ? int(lambda) : nearest_level(lambda);
    const double share = o.mip == MipMode::kLinear ? lambda - finer : 0;
    Shaded shaded = look_up_colour(object, point, finer);
    if (share > 0) {
      const Shaded coarser = look_up_colour(object, point, finer + 1);
      shaded = {shaded.diffuse * (1 - share) + coarser.diffuse * share,
                shaded.specular * (1 - share) + coarser.specular * share};
    }
    return blend(o.base.blend, base_sample(o, setup_.assets[object], point, o.filter).colour, shaded);
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
  // Light and view as they are at the object's origin.
  void shade_table(std::size_t object) {
    const Vec3d origin = setup_.scene.objects[object].transform.translation;
    std::vector<Arriving> lights;
    for (const Light& light : setup_.lights) lights.push_back(arriving(light, origin));
    colours_[object].table.shade({lights, setup_.scene.ambient, setup_.camera.to_viewer(origin)});
  }

  void expand(std::size_t object) {
    ObjectColours& colours = colours_[object];
    for (const IndexImage& level : setup_.assets[object].indexed->levels) {
      auto& planes = colours.expanded.emplace_back();
      for (int c = 0; c < colours.table.channels(); c++) {
        const std::vector<float>& table = colours.table.plane(c);
        std::vector<float>& plane = planes.emplace_back(level.texels());
        parallel_for(level.height, [&](std::size_t y) {
          const std::size_t first = y * level.width;
          for (std::size_t i = first; i < first + level.width; i++) plane[i] = table[level.data[i]];
        });
      }
    }
  }

  Addressing addressing(std::size_t object) const { return addressing_of(setup_.scene.objects[object].surface); }

  double lambda(std::size_t object, const SurfacePoint& point) const {
    if (setup_.scene.objects[object].mip == MipMode::kOff) return 0;
    const IndexedMap& map = *setup_.assets[object].indexed;
    return mip_lambda(point, map.width(), map.height(), setup_.samples, int(map.levels.size()));
  }

  // Colours are filtered, not indices: as hardware filters what it has looked up in a palette.
  Shaded look_up_colour(std::size_t object, const SurfacePoint& point, int level) const {
    const IndexedMap& map = *setup_.assets[object].indexed;
    const ObjectColours& colours = colours_[object];
    const int width = map.levels[level].width, height = map.levels[level].height;
    double channel[4]{};
    const auto add = [&](TexelPosition t, double weight) {
      for (int c = 0; c < colours.table.channels(); c++) channel[c] += colours.at(map, level, t, c) * weight;
    };
    if (setup_.scene.objects[object].filter == Filter::kNearest) {
      add(nearest_texel(point.u, point.v, width, height, addressing(object)), 1);
    } else {
      const BilinearTaps taps = bilinear_taps(point.u, point.v, width, height, addressing(object));
      for (int i = 0; i < 4; i++) add(taps.texel[i], taps.weight[i]);
    }
    const auto grey = [](double alpha) { return Vec3d{alpha, alpha, alpha}; };
    const Vec3d rgb{channel[0], channel[1], channel[2]};
    switch (colours.table.kind()) {
      case TableKind::kIntensity:
        return {grey(channel[0]), {}};
      case TableKind::kIntensityAndRgb:
        return {grey(channel[3]), rgb};
      case TableKind::kRgb:
        break;
    }
    return {rgb, {}};
  }

  FrameSetup setup_;
  std::vector<ObjectColours> colours_;
  double table_ms_ = 0;
};

}  // namespace

std::unique_ptr<ShadingPath> make_palette_path(const FrameSetup& setup, bool expanded) {
  return std::make_unique<PalettePath>(setup, expanded);
}

}  // namespace burnish
