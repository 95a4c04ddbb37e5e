#include "burnish/palette/index_mips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/indexed_rows.h"
#include "burnish/palette/nearest_entry.h"

namespace burnish {
namespace {

// The rows of a level that the next still needs.
template <typename T>
class RowWindow {
 public:
  explicit RowWindow(int width) : width_(std::size_t(width)) {}
  int end() const { return first_ + int(data_.size() / width_); }
  T* row(int y) { return data_.data() + width_ * std::size_t(y - first_); }
  const T* row(int y) const { return data_.data() + width_ * std::size_t(y - first_); }
  // Room for the next rows.
  T* append(int count) {
    data_.resize(data_.size() + width_ * count);
    return data_.data() + data_.size() - width_ * count;
  }
  void drop_before(int y) {
    data_.erase(data_.begin(), data_.begin() + std::ptrdiff_t(width_ * std::size_t(y - first_)));
    first_ = y;
  }

 private:
  std::size_t width_;
  int first_ = 0;
  std::vector<T> data_;
};

// Angles of texels; their root mean square.
struct SquaredAngles {
  void add(double rad) { sum += rad * rad, count++; }
  SquaredAngles& operator+=(const SquaredAngles& o) {
    sum += o.sum, count += o.count;
    return *this;
  }
  double rms_deg() const { return count ? degrees(std::sqrt(sum / double(count))) : 0; }

  double sum = 0;
  std::uint64_t count = 0;
};

struct Level {
  Level(int w, int h, std::size_t parts) : width(w), height(h), index(w), mean(parts, RowWindow<Vec3f>(w)) {}

  int width, height;
  RowWindow<std::uint16_t> index;
  // Weighted means of the base vectors under each texel, not renormalised: of all, or of those of each material, where
  // texels of other materials count as zero vectors. The base has them where they are not the palette's.
  std::vector<RowWindow<Vec3f>> mean;
  SquaredAngles angles;
};

// The normals below a texel, summed up by material.
struct Cover {
  int material;  // position of its interval
  std::int64_t weight;
  Vec3d sum;
  int first;  // index of the first texel of it
};

// Makes the levels side by side, each row as soon as the rows below it are there.
class Cascade {
 public:
  Cascade(const IndexRows& map, const IndexMipOptions& options, int levels, const IndexLevelSink& sink)
      : palette_(map.palette),
        from_base_(options.average == MipAverage::kBase || !options.source.empty()),
        has_source_(!options.source.empty()),
        by_material_(from_base_ && palette_.materials.size() > 1),
        sink_(sink) {
    for (const MaterialInterval& m : palette_.materials)
      nearest_.emplace_back(std::span(palette_.normals).subspan(m.first, m.count));
    for (int l = 0; l < levels; l++)
      levels_.emplace_back(level_size(map.width, l), level_size(map.height, l),
                           l > 0 ? parts() : std::size_t(has_source_));
  }

  std::size_t parts() const { return by_material_ ? palette_.materials.size() : 1; }

  // The next rows of the base and, where there is a source, its normals.
  void add(int count, const std::uint16_t* indices, const Vec3f* normals) {
    const std::size_t texels = std::size_t(count) * levels_[0].width;
    std::copy_n(indices, texels, levels_[0].index.append(count));
    if (has_source_) std::copy_n(normals, texels, levels_[0].mean[0].append(count));
    const int first = levels_[0].index.end() - count;
    if (has_source_) compare_with_source(first, count);
    sink_(0, count, levels_[0].index.row(first));
    for (std::size_t l = 1; l < levels_.size(); l++) make_rows(int(l));
    if (levels_.size() == 1) drop_before(levels_[0], first + count);
  }

  std::vector<MipLevelStats> stats() const {
    std::vector<MipLevelStats> stats;
    for (const Level& l : levels_) stats.push_back({l.width, l.height, l.angles.rms_deg()});
    return stats;
  }

 private:
  static void drop_before(Level& level, int row) {
    level.index.drop_before(row);
    for (RowWindow<Vec3f>& mean : level.mean) mean.drop_before(row);
  }

  static std::size_t rows_of_sum(int width) { return std::max<std::size_t>(1, (std::size_t(1) << 14) / width); }

  void compare_with_source(int first, int count) {
    Level& base = levels_[0];
    base.angles += parallel_sum<SquaredAngles>(count, rows_of_sum(base.width), [&](std::size_t begin, std::size_t end) {
      SquaredAngles s;
      for (int y = first + int(begin); y < first + int(end); y++)
        for (int x = 0; x < base.width; x++)
          s.add(angle_rad(Vec3d(base.mean[0].row(y)[x]), Vec3d(palette_.normals[base.index.row(y)[x]])));
      return s;
    });
  }

  // All rows of a level that the finer one suffices for.
  void make_rows(int l) {
    Level &finer = levels_[l - 1], &level = levels_[l];
    const auto needs = [&](int y) { return mip_taps(finer.height, y); };
    const int first = level.index.end();
    int end = first;
    while (end < level.height && needs(end).first + needs(end).count <= finer.index.end()) end++;
    if (end == first) return;
    level.index.append(end - first);
    for (RowWindow<Vec3f>& mean : level.mean) mean.append(end - first);
    level.angles +=
        parallel_sum<SquaredAngles>(end - first, rows_of_sum(level.width), [&](std::size_t begin, std::size_t stop) {
          SquaredAngles s;
          for (int y = first + int(begin); y < first + int(stop); y++) {
            average_row(l, y);
            index_row(l, y, s);
          }
          return s;
        });
    sink_(l, end - first, level.index.row(first));
    drop_before(finer, end < level.height ? needs(end).first : finer.height);
    if (l + 1 == int(levels_.size())) drop_before(level, end);
  }

  void average_row(int l, int y) {
    const Level& finer = levels_[l - 1];
    if (l == 1 && by_material_) return sum_by_material(y);
    for (std::size_t part = 0; part < parts(); part++) {
      Vec3f* out = levels_[l].mean[part].row(y);
      if (l > 1) average_row(finer, y, out, [&](int fx, int fy) { return finer.mean[part].row(fy)[fx]; });
      else average_row(finer, y, out, [&](int fx, int fy) { return base_normal(fx, fy); });
    }
  }

  Vec3f base_normal(int x, int y) const {
    return has_source_ ? levels_[0].mean[0].row(y)[x] : palette_.normals[levels_[0].index.row(y)[x]];
  }

  // A row of the first level: each texel of the base is of one material, and zero to the means of all others.
  void sum_by_material(int y) {
    const Level& base = levels_[0];
    std::vector<RowWindow<Vec3f>>& mean = levels_[1].mean;
    for (RowWindow<Vec3f>& part : mean) std::fill_n(part.row(y), levels_[1].width, Vec3f{});
    const MipTaps v = mip_taps(base.height, y);
    for (int x = 0; x < levels_[1].width; x++) {
      const MipTaps u = mip_taps(base.width, x);
      for (int j = 0; j < v.count; j++)
        for (int i = 0; i < u.count; i++) {
          const int fx = u.first + i, fy = v.first + j;
          Vec3f& sum = mean[palette_.interval_of(base.index.row(fy)[fx])].row(y)[x];
          sum += base_normal(fx, fy) * float(u.weight[i] * v.weight[j]);
        }
      for (RowWindow<Vec3f>& part : mean) part.row(y)[x] = part.row(y)[x] / float(u.total * v.total);
    }
  }

  template <typename VectorAt>
  static void average_row(const Level& finer, int y, Vec3f* out, const VectorAt& vector_at) {
    const MipTaps v = mip_taps(finer.height, y);
    for (int x = 0; x < next_level_size(finer.width); x++) {
      const MipTaps u = mip_taps(finer.width, x);
      Vec3f sum{};
      for (int j = 0; j < v.count; j++)
        for (int i = 0; i < u.count; i++) sum += vector_at(u.first + i, v.first + j) * float(u.weight[i] * v.weight[j]);
      out[x] = sum / float(u.total * v.total);
    }
  }

  void index_row(int l, int y, SquaredAngles& angles) {
    Level& level = levels_[l];
    std::uint16_t* out = level.index.row(y);
    for (int x = 0; x < level.width; x++) {
      const int index = index_of(l, x, y);
      out[x] = std::uint16_t(index);
      Vec3f sum{};
      for (const RowWindow<Vec3f>& mean : level.mean) sum += mean.row(y)[x];
      if (points(Vec3d(sum))) angles.add(angle_rad(Vec3d(sum), Vec3d(palette_.normals[index])));
    }
  }

  // Normals that cancel out point nowhere.
  static bool points(Vec3d sum) { return dot(sum, sum) > 1e-12; }

  int index_of(int l, int x, int y) const {
    const std::vector<RowWindow<Vec3f>>& mean = levels_[l].mean;
    if (from_base_ && palette_.materials.size() == 1)
      if (const Vec3f of_all = mean[0].row(y)[x]; points(Vec3d(of_all))) return nearest_[0](of_all);
    const Cover cover = majority(levels_[l - 1], x, y);
    const auto nearest = [&](Vec3f v) {
      return palette_.materials[cover.material].first + nearest_[cover.material](v);
    };
    // A material that has the majority of the level below may have no texel left in the base under this one.
    if (from_base_)
      if (const Vec3f of_base = mean[by_material_ ? cover.material : 0].row(y)[x]; points(Vec3d(of_base)))
        return nearest(of_base);
    return points(cover.sum) ? nearest(Vec3f(cover.sum)) : cover.first;  // the first stands for all
  }

  Cover majority(const Level& finer, int x, int y) const {
    const MipTaps u = mip_taps(finer.width, x), v = mip_taps(finer.height, y);
    std::array<Cover, 9> covers;
    std::size_t used = 0;
    for (int j = 0; j < v.count; j++) {
      const std::uint16_t* row = finer.index.row(v.first + j);
      for (int i = 0; i < u.count; i++) {
        const int index = row[u.first + i];
        const std::int64_t weight = u.weight[i] * v.weight[j];
        const int material = palette_.materials.size() == 1 ? 0 : palette_.interval_of(index);
        std::size_t c = 0;
        while (c < used && covers[c].material != material) c++;
        if (c == used) covers[used++] = {material, 0, {0, 0, 0}, index};
        covers[c].weight += weight;
        covers[c].sum += Vec3d(palette_.normals[index]) * double(weight);
      }
    }
    if (used == 1) return covers[0];
    const auto better = [&](const Cover& a, const Cover& b) {
      if (a.weight != b.weight) return a.weight > b.weight;
      const double la = dot(a.sum, a.sum), lb = dot(b.sum, b.sum);
      if (la != lb) return la > lb;
      return palette_.materials[a.material].id < palette_.materials[b.material].id;
    };
    return *std::min_element(covers.begin(), covers.begin() + used, better);
  }

  const Palette& palette_;
  bool from_base_, has_source_, by_material_;
  const IndexLevelSink& sink_;
  std::vector<NearestEntry> nearest_;  // of each material
  std::vector<Level> levels_;
};

}  // namespace

std::vector<MipLevelStats> make_index_mips(const IndexRows& map, const IndexMipOptions& options,
                                           const IndexLevelSink& sink, const Progress& progress) {
  const int levels = levels_to_make(map.width, map.height, options.levels);
  std::optional<NormalReader> source;
  if (!options.source.empty()) {
    source.emplace(options.source, options.coding);
    source->image().require_size(map.width, map.height, "the indexed map");
  }
  Cascade cascade(map, options, levels, sink);
  constexpr std::size_t kTexels = std::size_t(1) << 21;
  const int band = int(std::max<std::size_t>(2, kTexels / cascade.parts() / map.width));
  struct Band {
    std::vector<std::uint16_t> index;
    std::vector<Vec3f> normals;
  } here, next;
  const auto rows_from = [&](int y) { return std::min(band, map.height - y); };
  const auto read = [&](int y, Band& to) {
    if (y >= map.height) return;
    const std::size_t texels = std::size_t(rows_from(y)) * map.width;
    to.index.resize(texels);
    map.read_rows(y, rows_from(y), to.index.data());
    if (!source) return;
    to.normals.resize(texels);
    source->read_rows(y, rows_from(y), to.normals.data());
  };
  read(0, next);
  for (int y = 0; y < map.height; y += band) {
    std::swap(here, next);
    parallel_invoke([&] { read(y + band, next); },
                    [&] { cascade.add(rows_from(y), here.index.data(), source ? here.normals.data() : nullptr); });
    report_progress(progress, double(y + rows_from(y)) / map.height);
  }
  return cascade.stats();
}

std::vector<MipLevelStats> build_index_mips(IndexedMap& map, const IndexMipOptions& options, const Progress& progress) {
  const IndexImage& base = map.levels[0];
  std::deque<IndexImage> coarser;
  std::vector<IndexRowSink> sinks;
  const auto keep = [&](int level, int count, const std::uint16_t* rows) {
    if (level == 0) return;
    if (level > int(sinks.size())) sinks.push_back(append_to(coarser.emplace_back(), level_size(base.width, level)));
    sinks[level - 1](count, rows);
  };
  const auto read_rows = [&](int first, int count, std::uint16_t* out) {
    std::copy_n(base.row(first), std::size_t(count) * base.width, out);
  };
  const std::vector<MipLevelStats> stats =
      make_index_mips({map.palette, base.width, base.height, read_rows}, options, keep, progress);
  map.levels.resize(1);
  std::ranges::move(coarser, std::back_inserter(map.levels));
  return stats;
}

}  // namespace burnish
