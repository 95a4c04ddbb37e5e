// Kautz & Seidel, section 4.2: their equation 1 by the OpenGL imaging subset, three passes into an unsigned 8-bit frame
// buffer.
//
//   1  colour matrix: ½x + ½ with x = h·t/α_x, in float, from scaled and biased texels, clamped to [0,1];
//      lookup table of 256 entries: (2i − 1)², into an 8-bit texture; drawn
//   2  the same with b/α_y, blended by addition
//   3  subtracted from one; then k_s, from the alpha of the first texture, blended by multiplication
//
// and a diffuse pass by the same matrix, n·l. The matrix is constant while a texture is loaded: h must be the same
// all over the surface, hence directional lights, an orthographic viewer and flat surfaces. Textures are filtered after
// the matrix and the table, whatever order the scene asks for. What the passes give is 8 bits; the scene's colours
// weigh it after. Nothing asks for the sign of h·n, as with combiners.
#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/render/anisotropy/material_sample.h"
#include "burnish/render/anisotropy/reflectance_path.h"
#include "burnish/render/anisotropy/register_combiners.h"

namespace burnish {
namespace {

using combiners::held_unsigned;

// The colour matrix with a constant vector in its first row, made up for the texture's scale and bias.
float matrix(const MaterialTexture& texture, const float* stored, Vec3f row) {
  return dot(true_value(texture, stored).vector, row);
}

// The colour lookup table.
float squared(float x) {
  const float i = held_unsigned(0.5f * x + 0.5f), s = 2 * i - 1;
  return held_unsigned(s * s);
}

// The levels of a texture: squares of h·t/α_x and h·b/α_y, n·l, k_s.
std::vector<Image> load(const MaterialTextures& from, Vec3f h, Vec3f l) {
  std::vector<Image> out;
  for (std::size_t level = 0; level < from.t.levels.size(); level++) {
    const int width = from.t.levels[level].width, height = from.t.levels[level].height;
    Image& loaded = out.emplace_back(width, height, 4);
    parallel_for(height, [&](std::size_t y) {
      for (int x = 0; x < width; x++) {
        float* to = loaded.at(x, int(y));
        const MaterialSample s = material_sample(from, {int(level), {x, int(y)}, 1});
        const float* stored = s.stored.data();
        to[0] = squared(matrix(from.t, stored, h));
        to[1] = squared(matrix(from.b, stored + 4, h));
        to[2] = held_unsigned(matrix(from.n, stored + 8, l));
        to[3] = held_unsigned(true_value(from.t, stored).alpha);
      }
    });
  }
  return out;
}

class ImagingPath final : public ReflectancePath {
 public:
  explicit ImagingPath(const FrameSetup& setup) : ReflectancePath(setup, RenderPath::kImaging) {
    if (setup.scene.camera.type != CameraType::kOrthographic) refuse("needs an orthographic viewer");
    for (const Light& light : setup.lights)
      if (light.type != LightType::kDirectional) refuse("needs directional lights, got a point light");
    for (std::size_t i = 0; i < setup.scene.objects.size(); i++) {
      if (!object(i).surface.is_flat())
        refuse(std::string("needs flat surfaces, got a ") + name(object(i).surface.type));
      const MaterialTextures& textures = require_textures(i, MaterialModel::kBlinnPhong);
      SurfacePoint anywhere{};
      anywhere.frame_normal = anywhere.normal = {0, 0, 1};
      anywhere.tangent = {1, 0, 0}, anywhere.bitangent = {0, 1, 0};
      const LocalView view = local_view(setup, i, anywhere);
      auto& loaded = loaded_.emplace_back();
      for (const Arriving& light : view.lights) {
        const Vec3d sum = light.direction + view.to_viewer;
        loaded.push_back(load(textures, Vec3f(length(sum) > 0 ? normalized(sum) : sum), Vec3f(light.direction)));
      }
    }
  }

 protected:
  Extent extent(std::size_t i) const override { return extent_of_textures(i); }
  Vec3d normal(std::size_t i, const TextureTaps::Tap& tap) const override { return texture_normal(i, tap); }

  Reflected reflect(std::size_t i, const TextureTaps& taps, std::size_t light, Vec3d, Vec3d) const override {
    const std::vector<Image>& levels = loaded_[i][light];
    return filtered(
        FilterOrder::kBeforeShading, taps,
        [&](const TextureTaps::Tap& tap) {
          StoredSample<4> s;
          std::copy_n(levels[tap.level].at(tap.texel.x, tap.texel.y), 4, s.stored.begin());
          return s;
        },
        [](const StoredSample<4>& s) {
          float buffer = held_unsigned(s.stored[0]);
          buffer = held_unsigned(buffer + held_unsigned(s.stored[1]));
          buffer = held_unsigned(1 - buffer);
          return Reflected{held_unsigned(s.stored[2]), held_unsigned(buffer * held_unsigned(s.stored[3]))};
        });
  }

 private:
  std::vector<std::vector<std::vector<Image>>> loaded_;  // of each object, each light, each level
};

}  // namespace

std::unique_ptr<ShadingPath> make_imaging_path(const FrameSetup& setup) { return std::make_unique<ImagingPath>(setup); }

}  // namespace burnish
