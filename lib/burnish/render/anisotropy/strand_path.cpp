// Isidoro & Brennan's pixel shaders, in float. What the listings mean where they slip: ps.1.1 adds the table's alpha
// (it says the base map's, t1.a); ps.1.4 copies each light and the view to a register of its own (it copies all to r1).
// The lookup of the third puts ½ into z, so that the cube's face is met at ½x : ½y : ½.
#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/render/anisotropy/reflectance_maps.h"
#include "burnish/render/anisotropy/reflectance_path.h"

namespace burnish {
namespace {

struct StrandSample {
  Vec3f t, n;

  friend StrandSample operator*(StrandSample s, float w) { return {s.t * w, s.n * w}; }
  StrandSample& operator+=(const StrandSample& s) { return t += s.t, n += s.n, *this; }
};

class StrandPath final : public ReflectancePath {
 public:
  StrandPath(const FrameSetup& setup, RenderPath path)
      : ReflectancePath(setup, path),
        bumpy_(path == RenderPath::kStrandBump || path == RenderPath::kStrandBumpUnnormalised),
        file_(table(LookupKind::kStrand, bumpy_ ? TableLayout::kCubeZ : TableLayout::kOffsetHalf)) {
    const std::size_t most_lights = path == RenderPath::kStrandPs11 ? 1 : 4;
    if (setup.lights.size() > most_lights)
      refuse("takes " + std::string(most_lights == 1 ? "one light" : "up to four lights") + ", got " +
             std::to_string(setup.lights.size()));
    for (std::size_t i = 0; i < setup.scene.objects.size(); i++) {
      if (!reflectance(i).is_strand()) refuse("needs the model strand, which " + described(object(i)) + " has not");
      if (const double wanted = reflectance(i).strand_exponent; file_.function.exponent != wanted)
        refuse_table(LookupKind::kStrand, "exponent " + number_text(wanted), number_text(file_.function.exponent));
      if (bumpy_) continue;
      if (reflectance(i).gloss) refuse("has no gloss; strand-bump has");
      if (assets(i).reflectance->bumpy)
        refuse(
            "takes no normal map; make the direction map orthonormal to it (burnish-tangents --normal), or take "
            "strand-bump");
    }
  }

 protected:
  Extent extent(std::size_t i) const override {
    const MaterialMaps& maps = assets(i).reflectance->material;
    return {maps.width, maps.height, 1};
  }

  Vec3d normal(std::size_t i, const TextureTaps::Tap& tap) const override { return Vec3d(sample(i, tap).n); }

  Reflected reflect(std::size_t i, const TextureTaps& taps, std::size_t, Vec3d light, Vec3d view) const override {
    const Vec3f half_l = Vec3f(light) * 0.5f, half_v = Vec3f(view) * 0.5f;  // as the vertex shader leaves them
    return filtered(
        reflectance(i).order, taps, [&](const TextureTaps::Tap& tap) { return sample(i, tap); },
        [&](const StrandSample& s) {
          const Vec3f t = bumpy_ ? orthogonal(s) : s.t;
          float looked_up[4];
          file_.table.look_up(2 * dot(half_l, t), 2 * dot(half_v, t), looked_up);
          return Reflected{looked_up[0], looked_up[3]};
        });
  }

  // mul_sat, mad_sat
  Vec3d combined(Vec3d diffuse, Vec3d specular) const override {
    if (!bumpy_) return diffuse + specular;
    const auto saturated = [](Vec3d c) {
      return Vec3d{std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)};
    };
    return saturated(saturated(diffuse) + specular);
  }

 private:
  StrandSample sample(std::size_t i, const TextureTaps::Tap& tap) const {
    const ReflectanceMaps& maps = *assets(i).reflectance;
    const std::size_t texel = maps.texel(tap.texel.x, tap.texel.y);
    return {maps.directions[texel], maps.material.n[texel]};
  }

  // T − N (T·N), at its own length or at 1.
  Vec3f orthogonal(const StrandSample& s) const {
    const Vec3f t = s.t - s.n * dot(s.t, s.n);
    const float long_ = length(t);
    return path_ == RenderPath::kStrandBump && long_ > 0 ? t / long_ : t;
  }

  bool bumpy_;
  const TableFile& file_;
};

}  // namespace

std::unique_ptr<ShadingPath> make_strand_path(const FrameSetup& setup, RenderPath path) {
  return std::make_unique<StrandPath>(setup, path);
}

}  // namespace burnish
