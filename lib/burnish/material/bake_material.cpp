#include "burnish/material/bake_material.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "burnish/brdf/ward.h"
#include "burnish/core/band_rows.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr float kHalfMost = 65504;
constexpr float kExponentScale = 128;  // N/128 is stored

class Bake {
 public:
  Bake(MaterialModel model, const BakeOptions& options)
      : model_(model),
        options_(options),
        divided_(model != MaterialModel::kBanks),
        clamped_(divided_ && options.clamp_alpha && options.range == VectorRange::kCombiner) {
    if (divided_ && options_.range == VectorRange::kCombiner) stats_.scale = options_.alpha_min;
    if (is_integer(options.sample) && options.range == VectorRange::kFloat)
      throw Error(ErrorKind::kUsage, "encode: float needs half or float samples, which exr has, not " +
                                         std::string(name(options_.sample)));
  }

  // First all parameters, rows by rows, of numbers only any row.
  void survey(const MaterialMaps& rows) {
    require_storable(rows);
    if (model_ != MaterialModel::kWard) return;
    std::vector<double> most(rows.height);
    parallel_for(most.size(), [&](std::size_t y) {
      for (std::size_t i = y * rows.width; i < (y + 1) * rows.width; i++)
        most[y] = std::max(most[y], ward_scale_of(rows, i));
    });
    largest_ward_scale_ = std::max(largest_ward_scale_, std::ranges::max(most));
  }

  // Then: the textures without their levels.
  MaterialTextures head() const {
    MaterialTextures textures;
    textures.model = model_;
    textures.t = textures.b = texture(stats_.scale);
    textures.n = texture(1);
    if (model_ == MaterialModel::kBlinnPhong) textures.b.scale[3] = kExponentScale;
    if (model_ == MaterialModel::kWard) textures.n.scale[3] = ward_divisor();
    return textures;
  }

  // And the rows, as the one level of `textures`.
  void bake(const MaterialMaps& rows, MaterialTextures& textures) {
    for (std::size_t i = 0; i < 3; i++)
      textures.all()[i]->levels = {Image(rows.width, rows.height, channels_of(model_, "tbn"[i]))};
    std::vector<double> largest(rows.height);
    std::vector<std::size_t> clamped(rows.height);
    parallel_for(largest.size(), [&](std::size_t y) {
      bake_row(rows, int(y), textures, largest[y]);
      for (std::size_t i = y * rows.width; i < (y + 1) * rows.width; i++) clamped[y] += is_clamped(rows, i);
    });
    stats_.max_component = std::max(stats_.max_component, std::ranges::max(largest));
    for (const std::size_t n : clamped) stats_.clamped_texels += n;
    stats_.width = rows.width, stats_.height += rows.height;
    stats_.invalid_normal_texels += rows.invalid_normal_texels;
  }

  const BakeStats& stats() const { return stats_; }

 private:
  void require_storable(const MaterialMaps& rows) const {
    const bool integers = is_integer(options_.sample), combiner = options_.range == VectorRange::kCombiner;
    const std::string of = std::string(" in ") + name(options_.sample) + " samples";
    const float most = options_.sample == SampleType::kHalf ? kHalfMost : std::numeric_limits<float>::max();
    const float alpha_least = combiner ? float(options_.alpha_min) : 1 / most;
    if (divided_ && !clamped_)
      for (const Parameter* alpha : {&rows.alpha_x, &rows.alpha_y})
        alpha->require([&](float v) { return v >= alpha_least; },
                       "at least " + number_text(alpha_least) + (combiner ? " for the combiner range" : of));
    if (model_ == MaterialModel::kWard) return;
    const float channel_most = integers ? 1 : most, exponent_most = channel_most * kExponentScale;
    rows.k_s.require([&](float v) { return v <= channel_most; }, "at most " + number_text(channel_most) + of);
    rows.exponent.require([&](float v) { return v <= exponent_most; }, "at most " + number_text(exponent_most) + of);
  }

  // True values v are stored as (v − bias) / scale.
  MaterialTexture texture(double scale) const {
    MaterialTexture out;
    if (options_.range == VectorRange::kFloat) return out;
    std::fill_n(out.scale.begin(), 3, float(2 / scale));
    std::fill_n(out.bias.begin(), 3, float(-1 / scale));
    return out;
  }

  double alpha(const Parameter& of, std::size_t i) const {
    if (!divided_) return 1;
    return clamped_ ? std::max(double(of.at(i)), options_.alpha_min) : of.at(i);
  }
  bool is_clamped(const MaterialMaps& rows, std::size_t i) const {
    return clamped_ && std::min(rows.alpha_x.at(i), rows.alpha_y.at(i)) < options_.alpha_min;
  }
  double ward_scale_of(const MaterialMaps& rows, std::size_t i) const {
    return ward_scale({rows.k_s.at(i), alpha(rows.alpha_x, i), alpha(rows.alpha_y, i)});
  }
  float ward_divisor() const {
    if (largest_ward_scale_ > std::numeric_limits<float>::max())
      throw Error(ErrorKind::kMalformed, "k_s/(4 pi alpha_x alpha_y) is " + number_text(largest_ward_scale_) +
                                             ", which single precision does not hold");
    return largest_ward_scale_ > 0 ? float(largest_ward_scale_) : 1;
  }

  void bake_row(const MaterialMaps& rows, int y, MaterialTextures& textures, double& largest) const {
    for (int x = 0; x < rows.width; x++) {
      const std::size_t i = std::size_t(y) * rows.width + x;
      const Vec3d t(rows.t[i]), n(rows.n[i]);
      const Vec3d along = t / alpha(rows.alpha_x, i), across = cross(n, t) / alpha(rows.alpha_y, i);
      for (const Vec3d v : {along, across}) largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      store(textures.t, x, y, along, rows.k_s.at(i));
      store(textures.b, x, y, across, rows.exponent.at(i));
      store(textures.n, x, y, n, model_ == MaterialModel::kWard ? ward_scale_of(rows, i) : 0);
    }
  }
  static void store(MaterialTexture& texture, int x, int y, Vec3d v, double alpha) {
    float* to = texture.levels[0].at(x, y);
    const double values[4] = {v.x, v.y, v.z, alpha};
    for (int c = 0; c < texture.channels(); c++) to[c] = float((values[c] - texture.bias[c]) / texture.scale[c]);
  }

  MaterialModel model_;
  const BakeOptions& options_;
  bool divided_;  // by α
  bool clamped_;  // α, to its least
  double largest_ward_scale_ = 0;
  BakeStats stats_;
};

}  // namespace

BakedMaterial bake_material(const MaterialMaps& maps, const BakeOptions& options) {
  Bake bake(maps.model, options);
  bake.survey(maps);
  BakedMaterial baked{bake.head(), {}};
  bake.bake(maps, baked.textures);
  baked.stats = bake.stats();
  baked.stats.degenerate_texels = maps.degenerate_texels;
  return baked;
}

BakeStats bake_material(const MaterialSource& source, const BakeOptions& options, const MaterialTarget& target) {
  MaterialReader reader(source);
  Bake bake(source.model, options);
  const int width = reader.width(), height = reader.height(), at_once = band_rows(width);
  for (int y = 0; y < (reader.has_parameter_maps() ? height : 1); y += at_once)
    bake.survey(reader.parameters(y, std::min(at_once, height - y)));
  MaterialTextures textures = bake.head();
  MaterialTexturesWriter writer(textures, width, height, 1, target.t, target.b, target.n, target.type, options.sample);
  const std::string directory = std::filesystem::path(target.t.path).parent_path().string();
  const std::size_t degenerate = reader.frames(directory, [&](int first, MaterialMaps& frames) {
    MaterialMaps rows = reader.parameters(first, frames.height);
    rows.t = std::move(frames.t), rows.n = std::move(frames.n);
    rows.invalid_normal_texels = frames.invalid_normal_texels;
    bake.bake(rows, textures);
    writer.write_rows(0, textures.t.levels[0], textures.b.levels[0], textures.n.levels[0]);
  });
  writer.close();
  BakeStats stats = bake.stats();
  stats.degenerate_texels = degenerate;
  return stats;
}

}  // namespace burnish
