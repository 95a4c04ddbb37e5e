#include "burnish/material/mips/material_mips.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"
#include "burnish/material/mips/lobe_fit.h"
#include "burnish/material/mips/lobe_kernels.h"
#include "burnish/material/mips/lobe_moments.h"

namespace burnish {
namespace {

// What the base says of all its lobes.
struct Survey {
  AlphaRange range;
  double least_area = 1e9;  // product of the widths along t and along b, as α of ward
};

Survey survey(const MaterialTextures& textures, const std::string& name) {
  constexpr double kWidest = 2;  // nearly the whole hemisphere
  Survey s{{1e9, 0}};
  for (int y = 0; y < textures.height(); y++)
    for (int x = 0; x < textures.width(); x++) try {
        const Lobe o = lobe_at(textures, 0, x, y);
        const double unit = 2 * unit_variance(textures.model, o.exponent);
        s.least_area = std::min(s.least_area, unit * o.alpha_x * o.alpha_y);
        s.range.least = std::min({s.range.least, o.alpha_x, o.alpha_y});
        s.range.most = std::max({s.range.most, o.alpha_x, o.alpha_y, kWidest / std::sqrt(unit)});
      } catch (const Error& e) {
        throw file_error(e.kind(), name, e.what());
      }
  if (textures.model == MaterialModel::kBanks) s.range = {1, 1};
  return s;
}

// So many that some see the peak of the narrowest lobe.
std::size_t pair_blocks(double least_area) {
  return std::size_t(std::clamp(12 / least_area / PairBlock::kPairs, 32.0, 64.0));
}

// Goes up all levels at once, a row at a time: of each level three rows of means are kept, as many as one row above
// it needs.
class Pyramid {
 public:
  Pyramid(MaterialTextures& textures, const Survey& s, const Progress& progress)
      : textures_(textures),
        range_(s.range),
        pairs_(direction_pairs(pair_blocks(s.least_area))),
        wanted_(pairs_.size() * PairBlock::kPairs),
        levels_(textures.t.levels.size()),
        progress_(progress) {}

  // Fits all rows of the coarsest level, and with them those of all others.
  void run() {
    const int top = int(levels_.size()) - 1;
    for (int y = 0; y < level(top).height; y++) row(top, y);
  }

  MaterialMipLevel stats(int l) const {
    const Level& of = levels_[l];
    return {level(l).width, level(l).height, degrees(std::sqrt(of.sums.angle_square / double(level(l).texels()))),
            of.sums.wanted_square > 0 ? std::sqrt(of.sums.error_square / of.sums.wanted_square) : 0};
  }

 private:
  // Means over the base texels under each texel.
  struct Row {
    int y = -1;
    std::vector<LobeMoments> moments;
    std::vector<float> wanted;  // L_o, texel by texel, pair by pair
  };
  struct Sums {
    double angle_square = 0, error_square = 0, wanted_square = 0;
    Sums& operator+=(const Sums& o) {
      angle_square += o.angle_square, error_square += o.error_square, wanted_square += o.wanted_square;
      return *this;
    }
  };
  struct Level {
    Row rows[3];
    Sums sums;
  };

  const Image& level(int l) const { return textures_.t.levels[l]; }

  // Rows of a level are asked for in ascending order, none more than two behind the last.
  const Row& row(int l, int y) {
    Row& to = levels_[l].rows[y % 3];
    if (to.y == y) return to;
    to.y = y;
    to.moments.assign(level(l).width, {});
    to.wanted.assign(level(l).width * wanted_, 0);
    if (l == 0) make_base(to);
    else make(to, l);
    return to;
  }

  void make_base(Row& to) {
    parallel_for_chunks(to.moments.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t x = begin; x < end; x++) {
        const Lobe o = lobe_at(textures_, 0, int(x), to.y);
        to.moments[x] = LobeMoments(textures_.model, o);
        kernels::reflectance(textures_.model, o, pairs_, &to.wanted[x * wanted_]);
      }
    });
    report_progress(progress_, double(to.y + 1) / textures_.height());
  }

  void make(Row& to, int l) {
    const MipTaps v = mip_taps(level(l - 1).height, to.y);
    const Row* finer[3];
    for (int j = 0; j < v.count; j++) finer[j] = &row(l - 1, v.first + j);
    levels_[l].sums += parallel_sum<Sums>(to.moments.size(), 8, [&](std::size_t begin, std::size_t end) {
      Sums sums;
      for (std::size_t x = begin; x < end; x++) {
        const MipTaps u = mip_taps(level(l - 1).width, int(x));
        float* wanted = &to.wanted[x * wanted_];
        for (int j = 0; j < v.count; j++)
          for (int i = 0; i < u.count; i++) {
            const double weight = double(u.weight[i] * v.weight[j]) / (u.total * v.total);
            const float* from = &finer[j]->wanted[(u.first + i) * wanted_];
            to.moments[x].add(finer[j]->moments[u.first + i], weight);
            for (std::size_t p = 0; p < wanted_; p++) wanted[p] += float(weight) * from[p];
          }
        fit(to.moments[x], wanted, l, int(x), to.y, sums);
      }
      return sums;
    });
  }

  void fit(const LobeMoments& moments, const float* wanted, int l, int x, int y, Sums& sums) {
    const LobeFit found = fit_lobe(textures_.model, pairs_, wanted, moments.lobe(textures_.model), range_);
    put_lobe(turned_towards(textures_.model, found.lobe, moments.tangent()), textures_, l, x, y);
    for (std::size_t p = 0; p < wanted_; p++) sums.wanted_square += double(wanted[p]) * wanted[p];
    sums.error_square += found.error_square;
    const double off_rad = angle_rad(found.lobe.frame.n, moments.mean_normal());
    sums.angle_square += off_rad * off_rad;
  }

  MaterialTextures& textures_;
  AlphaRange range_;
  std::vector<PairBlock> pairs_;
  std::size_t wanted_;  // pairs a texel
  std::vector<Level> levels_;
  const Progress& progress_;
};

}  // namespace

std::vector<MaterialMipLevel> build_material_mips(MaterialTextures& textures, int levels, const std::string& name,
                                                  const Progress& progress) {
  levels = levels_to_make(textures.width(), textures.height(), levels);
  for (MaterialTexture* texture : {&textures.t, &textures.b, &textures.n}) {
    texture->levels.resize(1);
    for (int l = 1; l < levels; l++) {
      const Image& finer = texture->levels[l - 1];
      texture->levels.emplace_back(next_level_size(finer.width), next_level_size(finer.height), finer.channels);
    }
  }
  Pyramid pyramid(textures, survey(textures, name), progress);
  pyramid.run();
  std::vector<MaterialMipLevel> stats;
  for (int l = 0; l < levels; l++) stats.push_back(pyramid.stats(l));
  return stats;
}

}  // namespace burnish
