#include "burnish/material/bake_material.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/brdf/ward.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr float kHalfMost = 65504;
constexpr float kExponentScale = 128;  // N/128 is stored

class Bake {
 public:
  Bake(const MaterialMaps& maps, const BakeOptions& options)
      : maps_(maps),
        options_(options),
        divided_(maps.model != MaterialModel::kBanks),
        clamped_(divided_ && options.clamp_alpha && options.range == VectorRange::kCombiner) {}

  BakedMaterial run() {
    require_storable();
    BakedMaterial baked;
    if (divided_ && options_.range == VectorRange::kCombiner) baked.scale = options_.alpha_min;
    MaterialTextures& textures = baked.textures;
    textures.model = maps_.model;
    textures.t = texture(baked.scale, maps_.model != MaterialModel::kWard);
    textures.b = texture(baked.scale, maps_.model == MaterialModel::kBlinnPhong);
    textures.n = texture(1, maps_.model == MaterialModel::kWard);
    if (maps_.model == MaterialModel::kBlinnPhong) textures.b.scale[3] = kExponentScale;
    if (maps_.model == MaterialModel::kWard) textures.n.scale[3] = largest_ward_scale();
    std::vector<double> largest(maps_.height);
    parallel_for(maps_.height, [&](std::size_t y) { bake_row(int(y), textures, largest[y]); });
    baked.max_component = std::ranges::max(largest);
    for (std::size_t i = 0; i < maps_.t.size(); i++) baked.clamped_texels += is_clamped(i);
    return baked;
  }

 private:
  void require_storable() const {
    const bool integers = is_integer(options_.sample), combiner = options_.range == VectorRange::kCombiner;
    if (integers && !combiner)
      throw Error(ErrorKind::kUsage, "encode: float needs half or float samples, which exr has, not " +
                                         std::string(name(options_.sample)));
    const std::string of = std::string(" in ") + name(options_.sample) + " samples";
    const float most = options_.sample == SampleType::kHalf ? kHalfMost : std::numeric_limits<float>::max();
    const float alpha_least = combiner ? float(options_.alpha_min) : 1 / most;
    if (divided_ && !clamped_)
      for (const Parameter* alpha : {&maps_.alpha_x, &maps_.alpha_y})
        alpha->require([&](float v) { return v >= alpha_least; },
                       "at least " + number_text(alpha_least) + (combiner ? " for the combiner range" : of));
    if (maps_.model == MaterialModel::kWard) return;
    const float channel_most = integers ? 1 : most, exponent_most = channel_most * kExponentScale;
    maps_.k_s.require([&](float v) { return v <= channel_most; }, "at most " + number_text(channel_most) + of);
    maps_.exponent.require([&](float v) { return v <= exponent_most; }, "at most " + number_text(exponent_most) + of);
  }

  // True values v are stored as (v − bias) / scale.
  MaterialTexture texture(double scale, bool with_alpha) const {
    MaterialTexture out;
    out.levels.emplace_back(maps_.width, maps_.height, with_alpha ? 4 : 3);
    if (options_.range == VectorRange::kFloat) return out;
    std::fill_n(out.scale.begin(), 3, float(2 / scale));
    std::fill_n(out.bias.begin(), 3, float(-1 / scale));
    return out;
  }

  double alpha(const Parameter& of, std::size_t i) const {
    if (!divided_) return 1;
    return clamped_ ? std::max(double(of.at(i)), options_.alpha_min) : of.at(i);
  }
  bool is_clamped(std::size_t i) const {
    return clamped_ && std::min(maps_.alpha_x.at(i), maps_.alpha_y.at(i)) < options_.alpha_min;
  }
  double ward_scale_of(std::size_t i) const {
    return ward_scale({maps_.k_s.at(i), alpha(maps_.alpha_x, i), alpha(maps_.alpha_y, i)});
  }
  float largest_ward_scale() const {
    double most = 0;
    for (std::size_t i = 0; i < maps_.t.size(); i++) most = std::max(most, ward_scale_of(i));
    if (most > std::numeric_limits<float>::max())
      throw Error(ErrorKind::kMalformed,
                  "k_s/(4 pi alpha_x alpha_y) is " + number_text(most) + ", which single precision does not hold");
    return most > 0 ? float(most) : 1;
  }

  void bake_row(int y, MaterialTextures& textures, double& largest) const {
    for (int x = 0; x < maps_.width; x++) {
      const std::size_t i = std::size_t(y) * maps_.width + x;
      const Vec3d t(maps_.t[i]), n(maps_.n[i]);
      const Vec3d along = t / alpha(maps_.alpha_x, i), across = cross(n, t) / alpha(maps_.alpha_y, i);
      for (const Vec3d v : {along, across}) largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      store(textures.t, x, y, along, maps_.k_s.at(i));
      store(textures.b, x, y, across, maps_.exponent.at(i));
      store(textures.n, x, y, n, maps_.model == MaterialModel::kWard ? ward_scale_of(i) : 0);
    }
  }
  static void store(MaterialTexture& texture, int x, int y, Vec3d v, double alpha) {
    float* to = texture.levels[0].at(x, y);
    const double values[4] = {v.x, v.y, v.z, alpha};
    for (int c = 0; c < texture.channels(); c++) to[c] = float((values[c] - texture.bias[c]) / texture.scale[c]);
  }

  const MaterialMaps& maps_;
  const BakeOptions& options_;
  bool divided_;  // by α
  bool clamped_;  // α, to its least
};

}  // namespace

BakedMaterial bake_material(const MaterialMaps& maps, const BakeOptions& options) { return Bake(maps, options).run(); }

}  // namespace burnish
