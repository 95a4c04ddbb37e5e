#include "burnish/material/mips/material_mips.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  AlphaRange range{1e9, 0};
  double least_area = 1e9;  // product of the widths along t and along b, as α of ward
};

void survey(const MaterialTextures& rows, const std::string& name, Survey& s) {
  constexpr double kWidest = 2;  // nearly the whole hemisphere
  for (int y = 0; y < rows.height(); y++)
    for (int x = 0; x < rows.width(); x++) try {
        const Lobe o = lobe_at(rows, 0, x, y);
        const double unit = 2 * unit_variance(rows.model, o.exponent);
        s.least_area = std::min(s.least_area, unit * o.alpha_x * o.alpha_y);
        s.range.least = std::min({s.range.least, o.alpha_x, o.alpha_y});
        s.range.most = std::max({s.range.most, o.alpha_x, o.alpha_y, kWidest / std::sqrt(unit)});
      } catch (const Error& e) {
        throw file_error(e.kind(), name, e.what());
      }
  if (rows.model == MaterialModel::kBanks) s.range = {1, 1};
}

// So many that some see the peak of the narrowest lobe.
std::size_t pair_blocks(double least_area) {
  return std::size_t(std::clamp(12 / least_area / PairBlock::kPairs, 32.0, 64.0));
}

// Rows of the base that are read at once: what EXR compresses together.
constexpr int kBaseRows = 16;

// Goes up all levels at once, a row at a time: of each level as many rows of means are kept as one row above it needs.
// Of the base, which has most texels, only its lobes are: their reflectance is computed for each texel above them.
class Pyramid {
 public:
  Pyramid(int width, int height, int levels, const Survey& s, const ReadMaterialRows& read,
          const TakeMaterialRows& take, const Progress& progress)
      : range_(s.range),
        pairs_(direction_pairs(pair_blocks(s.least_area))),
        wanted_(pairs_.size() * PairBlock::kPairs),
        read_(read),
        take_(take),
        progress_(progress) {
    for (int l = 0; l < levels; l++, width = next_level_size(width), height = next_level_size(height))
      levels_.push_back({width, height, {}, {}});
  }

  // Fits all rows of the coarsest level, and with them those of all others.
  void run() {
    const int top = int(levels_.size()) - 1;
    for (int y = 0; y < levels_[top].height; y++) {
      if (top == 0) base_row(y);
      else row(top, y);
    }
  }

  MaterialMipLevel stats(int l) const {
    const Level& of = levels_[l];
    const double texels = double(of.width) * of.height;
    return {of.width, of.height, degrees(std::sqrt(of.sums.angle_square / texels)),
            of.sums.wanted_square > 0 ? std::sqrt(of.sums.error_square / of.sums.wanted_square) : 0};
  }

 private:
  struct BaseRow {
    int y = -1;
    std::vector<Lobe> lobes;
    std::vector<LobeMoments> moments;
  };
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
    int width, height;
    Row rows[3];
    Sums sums;
  };

  // Rows of a level are asked for in ascending order, none further behind the last than the row above them needs: of
  // an even height the other one of a pair.
  template <typename AnyRow>
  AnyRow& slot(AnyRow (&rows)[3], int l, int y) {
    return rows[y % (levels_[l].height % 2 == 0 ? 2 : 3)];
  }

  const Row& row(int l, int y) {
    Row& to = slot(levels_[l].rows, l, y);
    if (to.y == y) return to;
    to.y = y;
    to.moments.assign(levels_[l].width, {});
    to.wanted.assign(levels_[l].width * wanted_, 0);
    if (l == 1) make_from_base(to);
    else make(to, l);
    return to;
  }

  const BaseRow& base_row(int y) {
    BaseRow& to = slot(base_rows_, 0, y);
    if (to.y == y) return to;
    if (y == base_end_) {
      base_ = {};  // before there are others
      base_ = read_(y, std::min(kBaseRows, levels_[0].height - y));
      base_end_ += base_.height();
      take_(0, base_);
    }
    const int width = levels_[0].width;
    to.y = y;
    to.lobes.resize(width), to.moments.resize(width);
    parallel_for_chunks(std::size_t(width), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t x = begin; x < end; x++) {
        to.lobes[x] = lobe_at(base_, 0, int(x), y - base_.first_row);
        to.moments[x] = LobeMoments(base_.model, to.lobes[x]);
      }
    });
    report_progress(progress_, double(y + 1) / levels_[0].height);
    return to;
  }

  // What lies below texels of `to`: at(j, x) gives moments and L_o of texel x in the j-th finer row.
  struct Below {
    const LobeMoments& moments;
    const float* wanted;
  };
  void make(Row& to, int l) {
    const MipTaps v = mip_taps(levels_[l - 1].height, to.y);
    const Row* finer[3];
    for (int j = 0; j < v.count; j++) finer[j] = &row(l - 1, v.first + j);
    make(to, l, v, [&](int j, int x, std::vector<float>&) {
      return Below{finer[j]->moments[x], &finer[j]->wanted[x * wanted_]};
    });
  }
  void make_from_base(Row& to) {
    const MipTaps v = mip_taps(levels_[0].height, to.y);
    const BaseRow* base[3];
    for (int j = 0; j < v.count; j++) base[j] = &base_row(v.first + j);
    make(to, 1, v, [&](int j, int x, std::vector<float>& reflectance) {
      kernels::reflectance(base_.model, base[j]->lobes[x], pairs_, reflectance.data());
      return Below{base[j]->moments[x], reflectance.data()};
    });
  }
  template <typename At>
  void make(Row& to, int l, const MipTaps& v, const At& at) {
    MaterialTextures fitted{base_.model, base_.t.without_texels(), base_.b.without_texels(), base_.n.without_texels(),
                            to.y};
    const auto texels = [&](char which) { return Image(levels_[l].width, 1, channels_of(base_.model, which)); };
    fitted.t.levels = {texels('t')}, fitted.b.levels = {texels('b')}, fitted.n.levels = {texels('n')};
    levels_[l].sums += parallel_sum<Sums>(to.moments.size(), 8, [&](std::size_t begin, std::size_t end) {
      Sums sums;
      std::vector<float> scratch(wanted_);
      for (std::size_t x = begin; x < end; x++) {
        const MipTaps u = mip_taps(levels_[l - 1].width, int(x));
        float* wanted = &to.wanted[x * wanted_];
        for (int j = 0; j < v.count; j++)
          for (int i = 0; i < u.count; i++) {
            const double weight = double(u.weight[i] * v.weight[j]) / double(u.total * v.total);
            const Below from = at(j, u.first + i, scratch);
            to.moments[x].add(from.moments, weight);
            for (std::size_t p = 0; p < wanted_; p++) wanted[p] += float(weight) * from.wanted[p];
          }
        fit(to.moments[x], wanted, int(x), fitted, sums);
      }
      return sums;
    });
    take_(l, fitted);
  }

  void fit(const LobeMoments& moments, const float* wanted, int x, MaterialTextures& fitted, Sums& sums) {
    const MaterialModel model = base_.model;
    const LobeFit found = fit_lobe(model, pairs_, wanted, moments.lobe(model), range_);
    put_lobe(turned_towards(model, found.lobe, moments.tangent()), fitted, 0, x, 0);
    for (std::size_t p = 0; p < wanted_; p++) sums.wanted_square += double(wanted[p]) * wanted[p];
    sums.error_square += found.error_square;
    const double off_rad = angle_rad(found.lobe.frame.n, moments.mean_normal());
    sums.angle_square += off_rad * off_rad;
  }

  AlphaRange range_;
  std::vector<PairBlock> pairs_;
  std::size_t wanted_;  // pairs a texel
  std::vector<Level> levels_;
  const ReadMaterialRows& read_;
  const TakeMaterialRows& take_;
  const Progress& progress_;
  MaterialTextures base_;  // the rows that were read last
  int base_end_ = 0;
  BaseRow base_rows_[3];
};

}  // namespace

std::vector<MaterialMipLevel> make_material_mips(int width, int height, int levels, const std::string& name,
                                                 const ReadMaterialRows& read, const TakeMaterialRows& take,
                                                 const Progress& progress) {
  levels = levels_to_make(width, height, levels);
  Survey of_all;
  for (int y = 0; y < height; y += kBaseRows) survey(read(y, std::min(kBaseRows, height - y)), name, of_all);
  Pyramid pyramid(width, height, levels, of_all, read, take, progress);
  pyramid.run();
  std::vector<MaterialMipLevel> stats;
  for (int l = 0; l < levels; l++) stats.push_back(pyramid.stats(l));
  return stats;
}

}  // namespace burnish
