// What the paths of anisotropic reflectance have in common: each light is seen in the local frame, reflected in two
// parts, and added up. A path says how much is reflected.
#pragma once

#include "burnish/render/anisotropy/local_view.h"
#include "burnish/render/texture_taps.h"

namespace burnish {

struct Reflected {
  double diffuse = 0, specular = 0;  // per unit of light that falls at a right angle

  friend Reflected operator*(Reflected r, double w) { return {r.diffuse * w, r.specular * w}; }
  Reflected& operator+=(Reflected r) { return diffuse += r.diffuse, specular += r.specular, *this; }
};

class ReflectancePath : public ShadingPath {
 public:
  // kMalformed where an object has no reflectance.
  ReflectancePath(const FrameSetup& setup, RenderPath path);

  Vec3d shade(std::size_t object, const SurfacePoint& point) const final;
  LookedUp look_up(std::size_t object, const SurfacePoint& point) const final;

 protected:
  const Object& object(std::size_t i) const { return setup_.scene.objects[i]; }
  const ObjectAssets& assets(std::size_t i) const { return setup_.assets[i]; }
  const Reflectance& reflectance(std::size_t i) const { return *object(i).reflectance; }
  // kMalformed: the path in the scene's file.
  [[noreturn]] void refuse(const std::string& message) const;
  // The material textures of an object, which must be there and of that model; so must the object's own.
  const MaterialTextures& require_textures(std::size_t object, MaterialModel model) const;
  // A table that the scene must name.
  const TableFile& table(LookupKind kind, TableLayout layout) const;
  // kMalformed: the file of the table.
  [[noreturn]] void refuse_table(LookupKind kind, const std::string& wanted, const std::string& got) const;
  // Where an argument is known to go, lookups must not clamp.
  void require_domain(const TableFile& table, int argument, Range wanted) const;

  // Size and levels of what is looked up.
  struct Extent {
    int width, height, levels;
  };
  virtual Extent extent(std::size_t object) const = 0;
  Extent extent_of_textures(std::size_t object) const;
  // Unit vectors of the local frame; `light` counts the scene's.
  virtual Reflected reflect(std::size_t object, const TextureTaps& taps, std::size_t light, Vec3d l, Vec3d v) const = 0;
  // The colours of base and specular part put together, for a light of (1,1,1).
  virtual Vec3d combined(Vec3d diffuse, Vec3d specular) const { return diffuse + specular; }
  // Tangent space, of any length.
  virtual Vec3d normal(std::size_t object, const TextureTaps::Tap& tap) const = 0;
  Vec3d texture_normal(std::size_t object, const TextureTaps::Tap& tap) const;

  // The mean over the taps of what `shade` makes of each, or what it makes of the mean of what `sample` gives.
  template <typename Sample, typename Shade>
  static Reflected filtered(FilterOrder order, const TextureTaps& taps, const Sample& sample, const Shade& shade) {
    if (order == FilterOrder::kAfterShading) {
      Reflected sum;
      for (const TextureTaps::Tap& tap : taps) sum += shade(sample(tap)) * tap.weight;
      return sum;
    }
    auto mean = sample(*taps.begin()) * float(taps.begin()->weight);
    for (const auto* tap = taps.begin() + 1; tap != taps.end(); tap++) mean += sample(*tap) * float(tap->weight);
    return shade(mean);
  }

  FrameSetup setup_;
  RenderPath path_;

 private:
  TextureTaps taps(std::size_t object, const SurfacePoint& point) const;
};

// The formulas in double precision, from the unbaked maps, shaded before filtering: what an object's analytic path is
// where it has a reflectance.
class AnalyticReflectance final : public ReflectancePath {
 public:
  explicit AnalyticReflectance(const FrameSetup& setup);

 protected:
  Extent extent(std::size_t object) const override;
  Reflected reflect(std::size_t object, const TextureTaps& taps, std::size_t light, Vec3d l, Vec3d v) const override;
  Vec3d normal(std::size_t object, const TextureTaps::Tap& tap) const override;
};

// Banks, banks-approximate, blinn-phong, blinn-phong-eq1, ward: float arithmetic on material textures and tables
// (Kautz & Seidel, section 3).
std::unique_ptr<ShadingPath> make_table_path(const FrameSetup& setup, RenderPath path);
// strand-ps11, strand-ps14, strand-bump, strand-bump-unnormalised: Isidoro & Brennan's shaders.
std::unique_ptr<ShadingPath> make_strand_path(const FrameSetup& setup, RenderPath path);
// Kautz & Seidel, section 4.1 and 4.2.
std::unique_ptr<ShadingPath> make_combiner_path(const FrameSetup& setup);
std::unique_ptr<ShadingPath> make_imaging_path(const FrameSetup& setup);

}  // namespace burnish
