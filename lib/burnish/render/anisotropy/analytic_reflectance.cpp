#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/strand.h"
#include "burnish/brdf/ward.h"
#include "burnish/render/anisotropy/reflectance_maps.h"
#include "burnish/render/anisotropy/reflectance_path.h"

namespace burnish {
namespace {

// The halfway vector; of no length where light and view are opposite.
Vec3d halfway(Vec3d l, Vec3d v) {
  const Vec3d sum = l + v;
  return length(sum) > 0 ? normalized(sum) : sum;
}

Reflected evaluate(const Reflectance& r, const ReflectanceMaps& maps, std::size_t i, Vec3d l, Vec3d v) {
  const LocalFrame f = maps.frame(i);
  const MaterialMaps& m = maps.material;
  const double lit = std::max(0.0, dot(f.n, l)), k_s = m.k_s.at(i);
  const BlinnPhong blinn{k_s, m.alpha_x.at(i), m.alpha_y.at(i), m.exponent.at(i)};
  switch (r.model) {
    case ReflectanceModel::kBanks:
      return {lit, banks(f, k_s, l, v)};
    case ReflectanceModel::kBanksApproximate:
      return {lit, banks_approximate(f, k_s, l, v)};
    case ReflectanceModel::kBlinnPhong:
      return {lit, blinn_phong(f, blinn, halfway(l, v))};
    case ReflectanceModel::kBlinnPhongEquation1:
      return {lit, blinn_phong_equation_1(f, blinn, halfway(l, v))};
    case ReflectanceModel::kWard:
      return {lit, ward(f, {k_s, blinn.alpha_x, blinn.alpha_y}, l, v)};
    case ReflectanceModel::kStrand:
      break;
  }
  // Where there are no normals a direction may have been made orthogonal to some beforehand.
  const Vec3d t = maps.bumpy ? f.t : Vec3d(maps.directions[i]);
  return {strand_diffuse(dot(l, t)), strand_specular(dot(l, t), dot(v, t), r.strand_exponent)};
}

}  // namespace

AnalyticReflectance::AnalyticReflectance(const FrameSetup& setup) : ReflectancePath(setup, RenderPath::kAnalytic) {}

ReflectancePath::Extent AnalyticReflectance::extent(std::size_t object) const {
  const ReflectanceMaps& maps = *assets(object).reflectance;
  return {maps.material.width, maps.material.height, 1};
}

Reflected AnalyticReflectance::reflect(std::size_t object, const TextureTaps& taps, std::size_t, Vec3d l,
                                       Vec3d v) const {
  const ReflectanceMaps& maps = *assets(object).reflectance;
  Reflected sum;
  for (const TextureTaps::Tap& tap : taps)
    sum += evaluate(reflectance(object), maps, maps.texel(tap.texel.x, tap.texel.y), l, v) * tap.weight;
  return sum;
}

Vec3d AnalyticReflectance::normal(std::size_t object, const TextureTaps::Tap& tap) const {
  const ReflectanceMaps& maps = *assets(object).reflectance;
  return Vec3d(maps.material.n[maps.texel(tap.texel.x, tap.texel.y)]);
}

}  // namespace burnish
