#include "burnish/material/mips/lobe_maps.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/portable_math.h"
#include "burnish/material/mips/lobe.h"

namespace burnish {
namespace {

// put(lobe, samples of its texel) for every texel of every level.
template <typename Put>
std::vector<Image> maps_of(const MaterialTextures& textures, int channels, const Put& put) {
  std::vector<Image> maps;
  for (std::size_t l = 0; l < textures.t.levels.size(); l++) {
    Image& map = maps.emplace_back(textures.t.levels[l].width, textures.t.levels[l].height, channels);
    for (int y = 0; y < map.height; y++)
      for (int x = 0; x < map.width; x++) put(lobe_at(textures, int(l), x, y), map.at(x, y));
  }
  return maps;
}

void put_vector(Vec3d v, float* to) { to[0] = float(v.x), to[1] = float(v.y), to[2] = float(v.z); }

// α as ward has it: the width of the lobe, whatever its model.
struct Widths {
  double x, y;
  Widths(MaterialModel model, const Lobe& o) {
    const double unit = std::sqrt(2 * unit_variance(model, o.exponent));
    x = unit * o.alpha_x, y = unit * o.alpha_y;
  }
};

}  // namespace

void require_alpha(MaterialModel model) {
  if (model == MaterialModel::kBanks)
    throw Error(ErrorKind::kUnsupported, "banks has no alpha: its lobes are all of one width");
}

std::vector<Image> direction_maps(const MaterialTextures& textures) {
  return maps_of(textures, 3, [](const Lobe& o, float* to) { put_vector(o.frame.t, to); });
}

std::vector<Image> alpha_maps(const MaterialTextures& textures) {
  require_alpha(textures.model);
  return maps_of(textures, 3, [](const Lobe& o, float* to) { put_vector({o.alpha_x, o.alpha_y, o.k_s}, to); });
}

KhrMaps khr_maps(const MaterialTextures& textures) {
  require_alpha(textures.model);
  KhrMaps maps;
  maps.roughness = maps_of(textures, 1, [&](const Lobe& o, float* to) {
    const Widths w(textures.model, o);
    maps.wider_texels += std::max(w.x, w.y) > 1 + 1e-6;  // textures hold 1/α in floats
    *to = float(std::sqrt(std::min({w.x, w.y, 1.0})));
  });
  maps.anisotropy = maps_of(textures, 3, [&](const Lobe& o, float* to) {
    const Widths w(textures.model, o);
    const double wide = std::min(std::max(w.x, w.y), 1.0), narrow = std::min({w.x, w.y, 1.0});
    const Vec3d axis = w.x >= w.y ? o.frame.t : o.frame.b;
    const double flat = portable::hypot(axis.x, axis.y);
    const Vec3d along = flat > 0 ? axis / flat : Vec3d{1, 0, 0};
    put_vector({0.5 + 0.5 * along.x, 0.5 + 0.5 * along.y, narrow < 1 ? std::sqrt((wide - narrow) / (1 - narrow)) : 0},
               to);
  });
  return maps;
}

}  // namespace burnish
