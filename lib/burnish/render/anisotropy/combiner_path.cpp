// Kautz & Seidel, section 4.1: their equation 1 in two stages of register combiners and the final one.
//
//   stage 0   spare0 = 4 (t/α_x/4 · h), spare1 = 4 (b/α_y/4 · h), expanded from textures and the colour that holds h
//   stage 1   spare0 = spare0² + spare1²
//   final     (1 − spare0) k_s
//
// and a diffuse pass, n·l of the third texture and a colour that holds l. h and l are given at every pixel rather than
// at vertices, in the 8 bits of a colour. Textures are filtered before all of this, unless the scene asks for the
// other order to show what that costs (figure 2). What passes give is 8 bits; the scene's colours weigh it after.
// Nothing asks for the sign of h·n, which the twin keeps: bumps that turn away from h shine.
#include "burnish/core/error.h"
#include "burnish/render/anisotropy/material_sample.h"
#include "burnish/render/anisotropy/reflectance_path.h"
#include "burnish/render/anisotropy/register_combiners.h"

namespace burnish {
namespace {

using namespace combiners;

class CombinerPath final : public ReflectancePath {
 public:
  explicit CombinerPath(const FrameSetup& setup) : ReflectancePath(setup, RenderPath::kCombiner) {
    for (std::size_t i = 0; i < setup.scene.objects.size(); i++) {
      const MaterialTextures& t = require_textures(i, MaterialModel::kBlinnPhong);
      if (!(is_expanded_times(t.n, 1) &&
            (is_expanded_times(t.t, 1) || is_expanded_times(t.t, 2) || is_expanded_times(t.t, 4)) &&
            is_expanded_times(t.b, t.t.scale[0] / 2)))
        refuse(
            "needs textures in the combiners' range (burnish-material --encode combiner, --alpha-min 0.25, 0.5 or "
            "1), which those of " +
            described(object(i)) + " are not");
      scale_.push_back(t.t.scale[0] / 2);
    }
  }

 protected:
  Extent extent(std::size_t i) const override { return extent_of_textures(i); }
  Vec3d normal(std::size_t i, const TextureTaps::Tap& tap) const override { return texture_normal(i, tap); }

  Reflected reflect(std::size_t i, const TextureTaps& taps, std::size_t, Vec3d light, Vec3d view) const override {
    const MaterialTextures& textures = *assets(i).textures;
    const Vec3d sum = light + view;
    const Vec3f h = colour(length(sum) > 0 ? normalized(sum) : sum), l = colour(light);
    return filtered(
        reflectance(i).order, taps, [&](const TextureTaps::Tap& tap) { return material_sample(textures, tap); },
        [&](const MaterialSample& sample) {
          const auto texel = [&](int first) {
            const float* s = sample.stored.data() + first;
            return expand_normal(Vec3f{held_unsigned(s[0]), held_unsigned(s[1]), held_unsigned(s[2])});
          };
          float spare0 = dot_stage(texel(0), h, scale_[i]);
          const float spare1 = dot_stage(texel(4), h, scale_[i]);
          spare0 = sum_stage(spare0, spare0, spare1, spare1, 1);
          return Reflected{std::max(0.f, dot_stage(texel(8), l, 1)),
                           final_one_minus(spare0, held_unsigned(sample.stored[3]))};
        });
  }

 private:
  // A vector as vertices hand it on: biased, in 8 bits, and expanded again.
  static Vec3f colour(Vec3d v) {
    const auto channel = [](double c) { return expand_normal(held_unsigned(float(0.5 * c + 0.5))); };
    return {channel(v.x), channel(v.y), channel(v.z)};
  }

  // Whether true values are the expanded ones times that.
  static bool is_expanded_times(const MaterialTexture& texture, float times) {
    for (int c = 0; c < 3; c++)
      if (texture.scale[c] != 2 * times || texture.bias[c] != -times) return false;
    return true;
  }

  std::vector<float> scale_;  // of stage 0, an object each
};

}  // namespace

std::unique_ptr<ShadingPath> make_combiner_path(const FrameSetup& setup) {
  return std::make_unique<CombinerPath>(setup);
}

}  // namespace burnish
