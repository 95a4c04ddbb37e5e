#include "burnish/palette/index_mips.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/angle_stats.h"
#include "burnish/palette/nearest_entry.h"

namespace burnish {
namespace {

// Weighted means of base vectors under the texels of a level, not renormalised.
struct MeanLevel {
  int width = 0, height = 0;
  std::vector<Vec3f> mean;
};

// The next level of means; vector_at(x, y) gives those of the finer one, of width × height. Rows [first, end) only.
template <typename VectorAt>
void average_rows(int width, int height, const VectorAt& vector_at, int first, int end, MeanLevel& out) {
  parallel_for(end - first, [&](std::size_t r) {
    const int y = first + int(r);
    const MipTaps v = mip_taps(height, y);
    for (int x = 0; x < out.width; x++) {
      const MipTaps u = mip_taps(width, x);
      Vec3f sum{};
      for (int j = 0; j < v.count; j++)
        for (int i = 0; i < u.count; i++) sum += vector_at(u.first + i, v.first + j) * float(u.weight[i] * v.weight[j]);
      out.mean[std::size_t(y) * out.width + x] = sum / float(u.total * v.total);
    }
  });
}

MeanLevel next_level_of(int width, int height) {
  MeanLevel level{next_level_size(width), next_level_size(height), {}};
  level.mean.resize(std::size_t(level.width) * level.height);
  return level;
}

// Means of the base normals, all of them or those of each material, one level at a time.
class MeanPyramid {
 public:
  // With `by_material`, texels of other materials count as zero vectors in the means of one.
  MeanPyramid(const IndexedMap& map, const IndexMipOptions& options, bool by_material) : by_material_(by_material) {
    const std::size_t parts = by_material ? map.palette.materials.size() : 1;
    const int w = map.width(), h = map.height();
    levels_.assign(parts, next_level_of(w, h));
    std::optional<NormalReader> source;
    if (!options.source.empty()) {
      source.emplace(options.source, options.coding);
      source->image().require_size(w, h, "the indexed map");
    }
    constexpr int kRows = 128;
    std::vector<Vec3f> band;
    AngleStats base;
    const int coarse_rows = levels_[0].height;
    for (int y0 = 0; y0 < coarse_rows; y0 += kRows) {
      const int y1 = std::min(coarse_rows, y0 + kRows);
      const MipTaps last = mip_taps(h, y1 - 1);
      const int first = mip_taps(h, y0).first, rows = last.first + last.count - first;
      if (source) {
        band.resize(std::size_t(w) * rows);
        source->read_rows(first, rows, band.data());
        const int counted = y1 == coarse_rows ? rows : mip_taps(h, y1).first - first;  // each row once
        base += parallel_sum<AngleStats>(std::size_t(counted) * w, 1 << 14, [&](std::size_t begin, std::size_t end) {
          AngleStats s;
          for (std::size_t i = begin; i < end; i++)
            s.add(
                angle_rad(Vec3d(band[i]), Vec3d(map.palette.normals[map.levels[0].data[std::size_t(first) * w + i]])));
          return s;
        });
      }
      for (std::size_t part = 0; part < parts; part++)
        average_rows(
            w, h,
            [&](int x, int y) {
              const int index = *map.levels[0].at(x, y);
              if (by_material && map.palette.interval_of(index) != int(part)) return Vec3f{};
              return source ? band[std::size_t(y - first) * w + x] : map.palette.normals[index];
            },
            y0, y1, levels_[part]);
    }
    base_rms_deg_ = base.rms_deg();
  }

  double base_rms_deg() const { return base_rms_deg_; }  // 0 without a source

  void advance() {
    for (MeanLevel& level : levels_) {
      MeanLevel next = next_level_of(level.width, level.height);
      average_rows(
          level.width, level.height, [&](int x, int y) { return level.mean[std::size_t(y) * level.width + x]; }, 0,
          next.height, next);
      level = std::move(next);
    }
  }

  // Of one material, where kept by material.
  Vec3f mean(std::size_t texel, int material) const { return levels_[by_material_ ? material : 0].mean[texel]; }
  // Of all.
  Vec3f mean(std::size_t texel) const {
    Vec3f sum{};
    for (const MeanLevel& level : levels_) sum += level.mean[texel];
    return sum;
  }

 private:
  bool by_material_;
  std::vector<MeanLevel> levels_;
  double base_rms_deg_ = 0;
};

// The normals below a texel, summed up by material.
struct Cover {
  int material = 0;  // position of its interval
  int weight = 0;
  Vec3d sum;
  int first = 0;  // index of the first texel of it
};

Cover majority(const IndexedMap& map, const IndexImage& finer, int x, int y) {
  const MipTaps u = mip_taps(finer.width, x), v = mip_taps(finer.height, y);
  Cover covers[9];
  int used = 0;
  for (int j = 0; j < v.count; j++)
    for (int i = 0; i < u.count; i++) {
      const int index = *finer.at(u.first + i, v.first + j), weight = u.weight[i] * v.weight[j];
      const int material = map.palette.materials.size() == 1 ? 0 : map.palette.interval_of(index);
      int c = 0;
      while (c < used && covers[c].material != material) c++;
      if (c == used) covers[used++] = {material, 0, {}, index};
      covers[c].weight += weight;
      covers[c].sum += Vec3d(map.palette.normals[index]) * double(weight);
    }
  const auto better = [&](const Cover& a, const Cover& b) {
    if (a.weight != b.weight) return a.weight > b.weight;
    const double la = dot(a.sum, a.sum), lb = dot(b.sum, b.sum);
    if (la != lb) return la > lb;
    return map.palette.materials[a.material].id < map.palette.materials[b.material].id;
  };
  return *std::min_element(covers, covers + used, better);
}

}  // namespace

std::vector<MipLevelStats> build_index_mips(IndexedMap& map, const IndexMipOptions& options, const Progress& progress) {
  const int levels = levels_to_make(map.width(), map.height(), options.levels);
  const bool from_base = options.average == MipAverage::kBase || !options.source.empty();
  map.levels.resize(1);
  std::vector<NearestEntry> nearest;
  for (const MaterialInterval& m : map.palette.materials)
    nearest.emplace_back(std::span(map.palette.normals).subspan(m.first, m.count));
  MeanPyramid truth(map, options, from_base && map.palette.materials.size() > 1);

  std::vector<MipLevelStats> stats{{map.width(), map.height(), truth.base_rms_deg()}};
  for (int l = 1; l < levels; l++) {
    if (l > 1) truth.advance();
    const IndexImage& finer = map.levels[l - 1];
    IndexImage level(next_level_size(finer.width), next_level_size(finer.height));
    const AngleStats angles = parallel_sum<AngleStats>(level.height, 32, [&](std::size_t begin, std::size_t end) {
      AngleStats s;
      for (int y = int(begin); y < int(end); y++)
        for (int x = 0; x < level.width; x++) {
          const std::size_t texel = std::size_t(y) * level.width + x;
          const Cover cover = majority(map, finer, x, y);
          Vec3d wanted = cover.sum;
          // A material that has the majority of the level below may have no texel left in the base under this one.
          if (from_base)
            if (const Vec3d mean(truth.mean(texel, cover.material)); length(mean) > 1e-6) wanted = mean;
          // Normals that cancel out point nowhere: the first of them stands for all.
          const int index = length(wanted) > 1e-6
                                ? map.palette.materials[cover.material].first + nearest[cover.material](Vec3f(wanted))
                                : cover.first;
          level.data[texel] = std::uint16_t(index);
          if (const Vec3d mean(truth.mean(texel)); length(mean) > 1e-6)
            s.add(angle_rad(mean, Vec3d(map.palette.normals[index])));
        }
      return s;
    });
    map.levels.push_back(std::move(level));
    stats.push_back({map.levels[l].width, map.levels[l].height, angles.rms_deg()});
    report_progress(progress, 1 - std::pow(0.25, l));
  }
  return stats;
}

}  // namespace burnish
