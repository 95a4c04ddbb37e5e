#include "burnish/render/shading_path.h"

#include "burnish/render/anisotropy/reflectance_path.h"
#include "burnish/render/ptm/ptm_path.h"
#include "burnish/render/texture_taps.h"

namespace burnish {

std::unique_ptr<ShadingPath> make_path(RenderPath path, const FrameSetup& setup) {
  switch (path) {
    case RenderPath::kAnalytic:
      return make_analytic_path(setup);
    case RenderPath::kPalette:
      return make_palette_path(setup, false);
    case RenderPath::kPaletteExpanded:
      return make_palette_path(setup, true);
    case RenderPath::kCombiner:
      return make_combiner_path(setup);
    case RenderPath::kImaging:
      return make_imaging_path(setup);
    case RenderPath::kStrandPs11:
    case RenderPath::kStrandPs14:
    case RenderPath::kStrandBump:
    case RenderPath::kStrandBumpUnnormalised:
      return make_strand_path(setup, path);
    case RenderPath::kPtm:
    case RenderPath::kPtmBrdf:
      return make_ptm_path(setup, path);
    default:
      return make_table_path(setup, path);
  }
}

BaseSample base_sample(const Object& object, const ObjectAssets& assets, const SurfacePoint& point, Filter filter) {
  if (!assets.base_map) return {object.base.colour, 1};
  const Image& map = *assets.base_map;
  BaseSample sum{{}, 0};
  for (const TextureTaps::Tap& tap :
       texture_taps(point, {filter, MipMode::kOff, addressing_of(object.surface), 1}, map.width, map.height, 1)) {
    const float* s = map.at(tap.texel.x, tap.texel.y);
    sum.colour += Vec3d{s[0], s[1], s[2]} * tap.weight;
    sum.alpha += (map.channels > 3 ? s[3] : 1) * tap.weight;
  }
  return {object.base.colour * sum.colour, sum.alpha};
}

}  // namespace burnish
