#include <algorithm>
#include <limits>

#include "burnish/core/error.h"
#include "burnish/render/anisotropy/material_sample.h"
#include "burnish/render/anisotropy/reflectance_path.h"

namespace burnish {
namespace {

class TablePath final : public ReflectancePath {
 public:
  TablePath(const FrameSetup& setup, RenderPath path) : ReflectancePath(setup, path) {
    const MaterialModel model = model_of(path);
    for (std::size_t i = 0; i < setup.scene.objects.size(); i++) require_textures(i, model);
    if (path == RenderPath::kBanks) use_banks_table();
    if (path == RenderPath::kBlinnPhong) use_blinn_phong_table();
    if (path == RenderPath::kWard) use_ward_tables();
  }

 protected:
  Extent extent(std::size_t i) const override { return extent_of_textures(i); }
  Vec3d normal(std::size_t i, const TextureTaps::Tap& tap) const override { return texture_normal(i, tap); }

  Reflected reflect(std::size_t i, const TextureTaps& taps, std::size_t, Vec3d light, Vec3d view) const override {
    const MaterialTextures& textures = *assets(i).textures;
    const Vec3f l(light), v(view), sum = l + v;
    const Vec3f h = length(sum) > 0 ? normalized(sum) : sum;
    return filtered(
        reflectance(i).order, taps, [&](const TextureTaps::Tap& tap) { return material_sample(textures, tap); },
        [&](const MaterialSample& sample) {
          const MaterialVector t = true_value(textures.t, sample.stored.data()),
                               b = true_value(textures.b, sample.stored.data() + 4),
                               n = true_value(textures.n, sample.stored.data() + 8);
          return Reflected{std::max(0.f, dot(n.vector, l)), specular(t, b, n, l, v, h)};
        });
  }

 private:
  void use_banks_table() {
    const TableFile& r = table(LookupKind::kBanksR, TableLayout::kPlain);
    if (r.function.approximate) refuse_table(LookupKind::kBanksR, "R(s)", "R*(s); path banks-approximate needs none");
    require_domain(r, 0, {0, 1});
    first_ = &r.table;
  }

  void use_blinn_phong_table() {
    const TableFile& f = table(LookupKind::kBlinnPhongF, TableLayout::kPlain);
    for (std::size_t i = 0; i < setup_.scene.objects.size(); i++)
      require_domain(f, 0, exponents(assets(i).textures->b));
    require_domain(f, 1, {0, 1});
    first_ = &f.table;
  }

  // p below and m above the domain clamp: that is where the functions grow without bound, and where they are 0.
  void use_ward_tables() {
    const TableFile &s = table(LookupKind::kWardS, TableLayout::kPlain),
                    &e = table(LookupKind::kWardE, TableLayout::kPlain);
    require_domain(s, 0, {1, 1});
    require_domain(e, 0, {0, 0});
    require_domain(e, 1, {0, 1});
    first_ = &s.table, second_ = &e.table;
  }

  // The least and the largest N of all levels.
  static Range exponents(const MaterialTexture& b) {
    Range r{std::numeric_limits<double>::max(), 0};
    for (int level = 0; level < int(b.levels.size()); level++)
      for (int y = 0; y < b.levels[level].height; y++)
        for (int x = 0; x < b.levels[level].width; x++) {
          const double n = b.alpha(level, x, y);
          r = {std::min(r.least, n), std::max(r.most, n)};
        }
    return r;
  }

  static MaterialModel model_of(RenderPath path) {
    if (path == RenderPath::kWard) return MaterialModel::kWard;
    return path == RenderPath::kBanks || path == RenderPath::kBanksApproximate ? MaterialModel::kBanks
                                                                               : MaterialModel::kBlinnPhong;
  }

  float look_up(const LookupTable& table, float x, float y = 0) const {
    float value = 0;
    table.look_up(x, y, &value);
    return value;
  }

  float specular(const MaterialVector& t, const MaterialVector& b, const MaterialVector& n, Vec3f l, Vec3f v,
                 Vec3f h) const {
    const float lit = dot(n.vector, l), seen = dot(n.vector, v), d = dot(n.vector, h);
    const float x = dot(h, t.vector), y = dot(h, b.vector);
    switch (path_) {
      case RenderPath::kBanks: {
        const float vt = dot(v, t.vector), lt = dot(l, t.vector);
        const float fibre = look_up(*first_, vt * vt) * look_up(*first_, lt * lt) - vt * lt;
        return t.alpha * std::max(0.f, lit) * std::max(0.f, fibre);
      }
      case RenderPath::kBanksApproximate: {
        const float vt = dot(v, t.vector), lt = dot(l, t.vector);
        return t.alpha * std::max(0.f, lit) * std::max(0.f, (1 - vt * vt) * (1 - lt * lt) - vt * lt);
      }
      case RenderPath::kBlinnPhong:
        if (!(d > 0)) return 0;
        return t.alpha * look_up(*first_, b.alpha, std::max(0.f, 1 - x * x - y * y));
      case RenderPath::kBlinnPhongEquation1:
        return d > 0 ? t.alpha * std::max(0.f, 1 - x * x - y * y) : 0;
      default:
        break;
    }
    if (!(lit > 0 && seen > 0)) return 0;
    return n.alpha * look_up(*first_, lit * seen) * look_up(*second_, x * x + y * y, d) * lit;
  }

  const LookupTable *first_ = nullptr, *second_ = nullptr;
};

}  // namespace

std::unique_ptr<ShadingPath> make_table_path(const FrameSetup& setup, RenderPath path) {
  return std::make_unique<TablePath>(setup, path);
}

}  // namespace burnish
