#include "burnish/render/ptm/ptm_path.h"

#include <algorithm>
#include <array>

#include "burnish/brdf/light_factor.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/portable_math.h"
#include "burnish/render/anisotropy/local_view.h"
#include "burnish/render/picture.h"
#include "burnish/render/ptm/ptm_assets.h"
#include "burnish/render/texture_taps.h"

namespace burnish {
namespace {

template <typename R>
using Stored = std::array<R, 3 * kPtmTerms>;  // of a texel, or of several mixed

// In R's precision: a shader's, or a twin's.
template <typename R>
Vec3<R> evaluated(const PtmTexture& map, const Stored<R>& stored, R u, R v) {
  const auto polynomial = [&](int first) {
    PtmCoefficients<R> a;
    for (int k = 0; k < kPtmTerms; k++) a[k] = (stored[first + k] - R(map.bias[k])) * R(map.scale[k]);
    return evaluate(a, u, v);
  };
  if (map.type == PtmType::kRgb) return {polynomial(0), polynomial(kPtmTerms), polynomial(2 * kPtmTerms)};
  return Vec3<R>{stored[kPtmTerms], stored[kPtmTerms + 1], stored[kPtmTerms + 2]} * polynomial(0);
}

// The mean of texels.
template <typename R>
Stored<R> filtered(const Image& texels, const TextureTaps& taps) {
  Stored<R> sum{};
  for (const TextureTaps::Tap& tap : taps) {
    const float* texel = texels.at(tap.texel.x, tap.texel.y);
    for (int c = 0; c < texels.channels; c++) sum[c] += R(texel[c]) * R(tap.weight);
  }
  return sum;
}

// Decodes sRGB, and goes on with its curve above 1.
double linear(double srgb) { return srgb <= 1 ? linear_from_srgb(srgb) : portable::pow((srgb + 0.055) / 1.055, 2.4); }

class PtmPath : public ShadingPath {
 public:
  PtmPath(const FrameSetup& setup, RenderPath path) : setup_(setup), path_(path) {
    const auto found = setup.scene.tables.find(LookupKind::kLightFactor);
    if (found == setup.scene.tables.end()) refuse("needs the table of light-factor, [tables] light_factor");
    table_ = found->second.table.get();
    const Range domain = table_->function.domain[0];
    if (domain.least > 0 || domain.most < table_->function.transition)
      throw file_error(ErrorKind::kMalformed, found->second.file,
                       "expected a domain that holds the transition, 0:" + number_text(table_->function.transition) +
                           ", got " + number_text(domain.least) + ":" + number_text(domain.most));
  }

  Vec3d shade(std::size_t i, const SurfacePoint& point) const final {
    const LocalView view = local_view(setup_, i, point);
    Vec3d sum;
    for (const Arriving& light : view.lights) {
      const Vec3d lit = reflected(i, point, light.direction, view.to_viewer);
      sum += light.colour * factor(light.direction.z) *
             Vec3d{std::max(0.0, lit.x), std::max(0.0, lit.y), std::max(0.0, lit.z)};
    }
    return sum;
  }

  LookedUp look_up(std::size_t, const SurfacePoint& point) const final {
    LookedUp out;
    out.normal = point.frame_normal;
    return out;
  }

 protected:
  // Per unit of light, along unit vectors of the tangent frame.
  virtual Vec3d reflected(std::size_t object, const SurfacePoint& point, Vec3d l, Vec3d v) const = 0;
  virtual Vec3d factor(double cosine) const = 0;

  const Object& object(std::size_t i) const { return setup_.scene.objects[i]; }
  const PtmAssets& ptm(std::size_t i) const { return *setup_.assets[i].ptm; }
  [[noreturn]] void refuse(const std::string& message) const {
    throw file_error(ErrorKind::kMalformed, setup_.scene.name, std::string("path '") + name(path_) + "' " + message);
  }

  template <typename R>
  Vec3d spatial(std::size_t i, const PtmTexture& map, const SurfacePoint& point, Vec3d l) const {
    const Object& o = object(i);
    const TextureTaps taps = texture_taps(point, {o.filter, MipMode::kOff, addressing_of(o.surface), setup_.samples},
                                          map.stored.width, map.stored.height, 1);
    const Vec3d lit(evaluated<R>(map, filtered<R>(map.stored, taps), R(l.x), R(l.y)));
    if (!o.ptm->srgb) return lit;
    return {linear(lit.x), linear(lit.y), linear(lit.z)};
  }

  FrameSetup setup_;
  RenderPath path_;
  const TableFile* table_;
};

class BakedPtm final : public PtmPath {
 public:
  BakedPtm(const FrameSetup& setup, RenderPath path) : PtmPath(setup, path) {
    for (const Object& o : setup.scene.objects) {
      if (!o.ptm) refuse("needs an [object.ptm], and " + described(o) + " has none");
      if (o.ptm->is_brdf() != (path == RenderPath::kPtmBrdf))
        refuse(std::string("needs a ") + (o.ptm->is_brdf() ? "spatial map, and " : "BRDF PTM, and ") + described(o) +
               (o.ptm->is_brdf() ? " has a BRDF PTM" : " has no 'brdf'"));
    }
  }

 private:
  Vec3d reflected(std::size_t i, const SurfacePoint& point, Vec3d l, Vec3d v) const override {
    const PtmAssets& assets = ptm(i);
    if (!object(i).ptm->is_brdf()) return spatial<float>(i, assets.map, point, l);
    if (!(length(l + v) > 1e-9)) return {};
    const BrdfPlace at = brdf_place(assets.coordinates, l, v);
    // Row 0 is t = 0; v of texture coordinates runs up.
    const Image& texels = assets.map.stored;
    const auto half_texel = [](double c, int n) { return std::clamp(0.5 * c + 0.5, 0.5 / n, 1 - 0.5 / n); };
    const BilinearTaps taps =
        bilinear_taps(half_texel(at.x * assets.noise_factor, texels.width),
                      1 - half_texel(at.y * assets.noise_factor, texels.height), texels.width, texels.height, {});
    TextureTaps all;
    for (int k = 0; k < 4; k++) all.taps[all.count++] = {0, taps.texel[k], taps.weight[k]};
    return Vec3d(evaluated<float>(assets.map, filtered<float>(texels, all), float(at.u), float(at.v)));
  }

  Vec3d factor(double cosine) const override {
    float rgb[3];
    table_->table.look_up(float(cosine), 0, rgb);
    return {rgb[0], rgb[1], rgb[2]};
  }
};

class TwinOfPtm final : public PtmPath {
 public:
  explicit TwinOfPtm(const FrameSetup& setup) : PtmPath(setup, RenderPath::kAnalytic) {}

 private:
  Vec3d reflected(std::size_t i, const SurfacePoint& point, Vec3d l, Vec3d v) const override {
    if (object(i).ptm->is_brdf()) return ptm(i).brdf->reflected(l, v);
    return spatial<double>(i, ptm(i).reference, point, l);
  }

  Vec3d factor(double cosine) const override {
    const LookupFunction& f = table_->function;
    const auto channel = [&](double light) { return light_factor(cosine, light, f.ambient, f.transition); };
    return {channel(f.light.x), channel(f.light.y), channel(f.light.z)};
  }
};

}  // namespace

std::unique_ptr<ShadingPath> make_ptm_path(const FrameSetup& setup, RenderPath path) {
  return std::make_unique<BakedPtm>(setup, path);
}

AnalyticPtm::AnalyticPtm(const FrameSetup& setup) {
  if (std::ranges::any_of(setup.scene.objects, [](const Object& o) { return o.ptm.has_value(); }))
    path_ = std::make_unique<TwinOfPtm>(setup);
}
AnalyticPtm::~AnalyticPtm() = default;
Vec3d AnalyticPtm::shade(std::size_t object, const SurfacePoint& point) const { return path_->shade(object, point); }
LookedUp AnalyticPtm::look_up(std::size_t object, const SurfacePoint& point) const {
  return path_->look_up(object, point);
}

}  // namespace burnish
