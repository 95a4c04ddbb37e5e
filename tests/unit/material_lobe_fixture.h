// Lobes, what they reflect by the formulas in double precision, and textures made of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/ward.h"
#include "burnish/material/mips/lobe.h"
#include "burnish/material/mips/material_mips.h"

namespace burnish {

inline constexpr MaterialModel kAllModels[] = {MaterialModel::kWard, MaterialModel::kBlinnPhong, MaterialModel::kBanks};

inline double reference_reflectance(MaterialModel model, const Lobe& o, Vec3d l, Vec3d v) {
  if (model == MaterialModel::kBanks) return banks(o.frame, o.k_s, l, v);
  if (model == MaterialModel::kWard) return ward(o.frame, {o.k_s, o.alpha_x, o.alpha_y}, l, v);
  return blinn_phong(o.frame, {o.k_s, o.alpha_x, o.alpha_y, o.exponent}, normalized(l + v));
}

// The frame of a normal map's texel of these slopes, its t along +u turned about n.
inline LocalFrame frame_of(double slope_x, double slope_y, double turn_rad = 0) {
  return *orthonormal_frame({-slope_x, -slope_y, 1}, {std::cos(turn_rad), std::sin(turn_rad), 0});
}

// What a model has no use for is as lobe_at() leaves it.
inline Lobe lobe_of(MaterialModel model, const LocalFrame& frame, double alpha_x, double alpha_y, double k_s = 0.8) {
  Lobe o{frame, 1, 1, k_s, 0};
  if (model != MaterialModel::kBanks) o.alpha_x = alpha_x, o.alpha_y = alpha_y;
  if (model == MaterialModel::kBlinnPhong) o.exponent = 12, o.alpha_x *= 3, o.alpha_y *= 3;
  return o;
}

inline Lobe random_lobe(MaterialModel model, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto alpha = [&] { return 0.1 + 0.4 * unit(random); };
  const LocalFrame frame = frame_of(unit(random) - 0.5, unit(random) - 0.5, 2 * kPi * unit(random));
  const double x = alpha(), y = alpha();
  return lobe_of(model, frame, x, y, 0.2 + unit(random));
}

// Lights within 73° and views within 46° of (0,0,1).
struct Pair {
  Vec3d l, v;
};
inline Pair random_pair(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto in_cap = [&](double least_cosine) {
    const double z = 1 - (1 - least_cosine) * unit(random), turn_rad = 2 * kPi * unit(random), r = std::sqrt(1 - z * z);
    return Vec3d{r * std::cos(turn_rad), r * std::sin(turn_rad), z};
  };
  const Vec3d l = in_cap(0.3);
  return {l, in_cap(0.7)};
}

// One level, floats as they are; what each texel is, by lobe_at(x, y).
template <typename LobeAt>
MaterialTextures textures_of(MaterialModel model, int width, int height, const LobeAt& at) {
  MaterialTextures m;
  m.model = model;
  m.t.levels.emplace_back(width, height, model == MaterialModel::kWard ? 3 : 4);
  m.b.levels.emplace_back(width, height, model == MaterialModel::kBlinnPhong ? 4 : 3);
  m.n.levels.emplace_back(width, height, model == MaterialModel::kWard ? 4 : 3);
  if (model == MaterialModel::kBlinnPhong) m.b.scale[3] = 128;
  if (model == MaterialModel::kWard) m.n.scale[3] = 7;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) put_lobe(at(x, y), m, 0, x, y);
  return m;
}

// Mips in memory: replaces levels[1 …] of all three.
inline std::vector<MaterialMipLevel> build_material_mips(MaterialTextures& m, int levels, const std::string& name) {
  MaterialTextures made{m.model, m.t.without_texels(), m.b.without_texels(), m.n.without_texels()};
  const auto read = [&](int first, int count) {
    MaterialTextures rows{m.model, m.t.without_texels(), m.b.without_texels(), m.n.without_texels(), first};
    for (int i = 0; i < 3; i++) {
      const Image& all = m.all()[i]->levels[0];
      Image& part = rows.all()[i]->levels.emplace_back(all.width, count, all.channels);
      std::copy_n(all.row(first), part.data.size(), part.data.begin());
    }
    return rows;
  };
  const auto take = [&](int level, const MaterialTextures& rows) {
    for (int i = 0; i < 3; i++) {
      const Image& from = rows.all()[i]->levels[0];
      std::vector<Image>& to = made.all()[i]->levels;
      if (level >= int(to.size())) to.resize(level + 1);
      if (to[level].height == 0) to[level] = Image(from.width, 0, from.channels);
      EXPECT_EQ(rows.first_row, to[level].height) << "level " << level;
      to[level].data.insert(to[level].data.end(), from.data.begin(), from.data.end());
      to[level].height += from.height;
    }
  };
  const std::vector<MaterialMipLevel> stats = make_material_mips(m.width(), m.height(), levels, name, read, take);
  m = made;
  return stats;
}

}  // namespace burnish
