#include "burnish/palette/quantize.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/angle_stats.h"
#include "burnish/palette/codebook.h"
#include "burnish/palette/dither.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/imagequant_engine.h"
#include "burnish/palette/median_cut.h"
#include "burnish/palette/palette_order.h"

namespace burnish {
namespace {

void check(const QuantizeOptions& o) {
  const auto usage = [](const std::string& message) { throw Error(ErrorKind::kUsage, message); };
  if (o.normals < 2 || o.normals > kMaxPaletteSize)
    usage("normals: expected 2 to 65536, got " + std::to_string(o.normals));
  if (o.target_error_deg && !(*o.target_error_deg >= 0 && *o.target_error_deg <= 180))
    usage("target error: expected degrees from 0 to 180");
  if (!(o.dither_amount >= 0 && o.dither_amount <= 1)) usage("dither amount: expected 0 to 1");
  if (o.engine == Engine::kImagequant && o.palette.empty() && !o.target_error_deg && o.normals > kImagequantMost)
    throw Error(ErrorKind::kUnsupported,
                "the engine imagequant holds at most 256 normals, not " + std::to_string(o.normals));
}

Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [=](double f) { progress(from + f * (to - from)); };
}

// Entries of each group, in the order of the curve.
using Groups = std::vector<std::vector<Vec3f>>;

Groups fit(const Histogram& histogram, Engine engine, int n, const Progress& progress) {
  const auto& points = histogram.groups;
  Groups groups;
  if (engine == Engine::kSpherical) {
    groups = fit_codebook(points, n, progress).groups;
  } else {
    const std::vector<int> share = share_entries(points, n);
    for (std::size_t g = 0; g < points.size(); g++)
      groups.push_back(engine == Engine::kMedianCut ? fit_median_cut(points[g], share[g])
                                                    : fit_imagequant(points[g], share[g]));
  }
  for (std::vector<Vec3f>& entries : groups)
    std::ranges::sort(entries, {}, [](Vec3f v) { return std::tuple(curve_position(v), v.x, v.y, v.z); });
  return groups;
}

Palette to_palette(const Groups& groups, const std::vector<int>& ids, NormalSpace space) {
  Palette palette;
  palette.space = space;
  for (std::size_t g = 0; g < groups.size(); g++) {
    palette.materials.push_back({ids[g], int(palette.normals.size()), int(groups[g].size())});
    palette.normals.insert(palette.normals.end(), groups[g].begin(), groups[g].end());
  }
  return palette;
}

// How to find the nearest entries of each of the histogram's groups in a palette.
std::vector<EntryRange> entry_ranges(const Palette& palette, const std::vector<int>& ids, const std::string& name) {
  std::vector<EntryRange> ranges;
  for (int id : ids) {
    const auto m = std::ranges::find(palette.materials, id, &MaterialInterval::id);
    if (m == palette.materials.end()) {
      std::string has;
      for (const MaterialInterval& i : palette.materials) has += (has.empty() ? "" : ", ") + std::to_string(i.id);
      throw file_error(ErrorKind::kMalformed, name,
                       "expected entries for material " + std::to_string(id) + ", got " + has);
    }
    ranges.push_back({m->first, NearestEntry(std::span(palette.normals).subspan(m->first, m->count))});
  }
  return ranges;
}

// The angles of the whole map when each texel takes its nearest entry, by its distinct normals.
AngleStats nearest_angles(const Histogram& histogram, const Palette& palette, const std::vector<EntryRange>& ranges) {
  AngleStats total;
  for (std::size_t g = 0; g < histogram.groups.size(); g++) {
    if (!histogram.counts[g]) continue;
    const std::vector<WeightedNormal>& points = histogram.groups[g];
    total += parallel_sum<AngleStats>(points.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
      AngleStats s;
      for (std::size_t i = begin; i < end; i++) {
        const Vec3f entry = palette.normals[ranges[g].first + ranges[g].nearest(points[i].normal)];
        s.add(angle_rad(Vec3d(points[i].normal), Vec3d(entry)), std::uint64_t(points[i].weight));
      }
      return s;
    });
  }
  return total;
}

// The smallest palette that meets the target, between one that fails and the next, which does not. Errors fall with the
// root of the size, so a measured palette foretells where to look next; where that narrows too little, the middle is
// taken.
Palette fit_to_target(const Histogram& histogram, const QuantizeOptions& o, const Progress& progress) {
  const int most = o.engine == Engine::kImagequant ? kImagequantMost : kMaxPaletteSize;
  const int least = std::max<int>(1, int(histogram.groups.size()));
  struct Measured {
    int size;
    double rms_deg;
    Palette palette;
  };
  const auto measure = [&](int n) {
    Measured m{
        n, 0, to_palette(fit(histogram, o.engine, n, {}), histogram.material, o.space.value_or(NormalSpace::kTangent))};
    m.rms_deg = nearest_angles(histogram, m.palette, entry_ranges(m.palette, histogram.material, "palette")).rms_deg();
    return m;
  };
  const auto foretold = [&](const Measured& m) {
    const double ratio = *o.target_error_deg > 0 ? m.rms_deg / *o.target_error_deg : most;
    return std::min(double(most), m.size * ratio * ratio);
  };

  Measured good = measure(std::clamp(256, least, most));
  int fails = least - 1;
  while (good.rms_deg > *o.target_error_deg) {
    if (good.size >= most)
      throw Error(ErrorKind::kThreshold,
                  "target error: expected an RMS angle of at most " + std::to_string(*o.target_error_deg) +
                      " degrees, got " + std::to_string(good.rms_deg) + " with " + std::to_string(most) + " normals");
    fails = good.size;
    good = measure(std::clamp(int(foretold(good) * 1.02) + 1, fails + 1, most));
  }
  double guess = foretold(good);
  const int interval_at_first = good.size - fails;
  for (bool halve = false; good.size - fails > 1;) {
    const int interval = good.size - fails;
    const int n = halve ? fails + interval / 2 : std::clamp(int(guess), fails + 1, good.size - 1);
    Measured m = measure(n);
    guess = foretold(m);
    if (m.rms_deg > *o.target_error_deg) fails = n;
    else good = std::move(m);
    halve = !halve && (good.size - fails) * 2 > interval;
    report_progress(progress, 1 - double(good.size - fails) / interval_at_first);
  }
  return std::move(good.palette);
}

// Index of every texel.
class Mapper {
 public:
  Mapper(TexelKeys& texels, const TexelClasses& classes, const Histogram& histogram, const Palette& palette,
         const std::vector<EntryRange>& ranges, const QuantizeOptions& options)
      : texels_(texels),
        classes_(classes),
        histogram_(histogram),
        palette_(palette),
        ranges_(ranges),
        options_(options) {
    group_.assign(256, 0);
    for (std::size_t g = 0; g < histogram.material.size(); g++) group_[histogram.material[g]] = std::uint16_t(g);
  }

  // Fills the index; the angles of the texels that count.
  AngleStats run(IndexImage& index, const Progress& progress) {
    const bool by_key = histogram_.exact && options_.dither == Dither::kNone;
    if (by_key) prepare_keys();
    AngleStats stats;
    if (by_key) stats = nearest_angles(histogram_, palette_, ranges_);
    const int w = texels_.width(), h = texels_.height();
    std::vector<const EntryRange*> range_of_region;
    for (const EntryRange& r : ranges_) range_of_region.insert(range_of_region.end(), 2, &r);
    ErrorDiffusion diffusion(palette_.normals, range_of_region, w, options_.dither_amount);
    constexpr int kBands = 4, kRows = kBands * kDotBandRows;
    std::vector<std::uint64_t> keys(std::size_t(w) * std::min(h, kRows));
    for (int y0 = 0; y0 < h; y0 += kRows) {
      const int rows = std::min(kRows, h - y0);
      texels_.read_rows(y0, rows, keys.data());
      if (by_key) {
        parallel_for(rows, [&](std::size_t r) { map_row(y0 + int(r), keys.data() + r * w, index.row(y0 + int(r))); });
      } else {
        const Texels band = decode(y0, rows, keys.data());
        switch (options_.dither) {
          case Dither::kDiffusion:
            diffuse(diffusion, band, index);
            break;
          case Dither::kBlueNoise:
            parallel_for_chunks(rows, kDotBandRows, [&](std::size_t begin, std::size_t end, std::size_t) {
              diffuse_dots(palette_.normals, range_of_region, w, int(end - begin), band.normals.data() + begin * w,
                           band.region.data() + begin * w, options_.dither_amount, index.row(y0 + int(begin)));
            });
            break;
          case Dither::kNone:
            parallel_for(rows, [&](std::size_t r) { find_row(band, r, index.row(y0 + int(r))); });
        }
        stats += parallel_sum<AngleStats>(rows, 64, [&](std::size_t begin, std::size_t end) {
          AngleStats s;
          for (std::size_t i = begin * w; i < end * w; i++)
            if (band.region[i] % 2)
              s.add(angle_rad(Vec3d(band.normals[i]), Vec3d(palette_.normals[index.data[std::size_t(y0) * w + i]])));
          return s;
        });
      }
      report_progress(progress, double(y0 + rows) / h);
    }
    return stats;
  }

 private:
  // A band of rows, and the region of the row below it.
  struct Texels {
    int first, rows;
    std::vector<Vec3f> normals;
    std::vector<std::uint16_t> region;
  };

  Texels decode(int y0, int rows, const std::uint64_t* keys) const {
    const std::size_t w = texels_.width();
    const int region_rows = std::min(rows + 1, texels_.height() - y0);
    Texels band{y0, rows, std::vector<Vec3f>(w * rows), std::vector<std::uint16_t>(w * region_rows)};
    parallel_for(rows, [&](std::size_t r) {
      bool invalid;
      for (std::size_t i = r * w; i < (r + 1) * w; i++) band.normals[i] = texels_.decode(keys[i], invalid);
    });
    parallel_for(region_rows, [&](std::size_t r) {
      for (std::size_t x = 0; x < w; x++) band.region[r * w + x] = region(int(x), y0 + int(r));
    });
    return band;
  }

  void prepare_keys() {
    nearest_.resize(histogram_.keys.size());
    parallel_for_chunks(histogram_.keys.size(), 4096, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; i++) {
        const Histogram::Key& k = histogram_.keys[i];
        nearest_[i] = std::uint16_t(ranges_[k.group].first + ranges_[k.group].nearest(k.normal));
      }
    });
  }

  void map_row(int y, const std::uint64_t* keys, std::uint16_t* out) const {
    std::uint64_t last = ~std::uint64_t(0);
    std::uint16_t entry = 0;
    for (int x = 0; x < texels_.width(); x++) {
      const std::uint64_t material = std::uint64_t(classes_.material_at(x, y)) << 48, key = material | keys[x];
      if (x + KeyTable::kAhead < texels_.width()) histogram_.table.prefetch(material | keys[x + KeyTable::kAhead]);
      if (key != last) entry = nearest_[histogram_.table.at(key)], last = key;
      out[x] = entry;
    }
  }

  void find_row(const Texels& band, std::size_t r, std::uint16_t* out) const {
    const std::size_t w = texels_.width();
    for (std::size_t x = 0; x < w; x++) {
      const EntryRange& range = ranges_[band.region[r * w + x] / 2];
      out[x] = std::uint16_t(range.first + range.nearest(band.normals[r * w + x]));
    }
  }

  void diffuse(ErrorDiffusion& diffusion, const Texels& band, IndexImage& index) const {
    const std::size_t w = texels_.width();
    for (int r = 0; r < band.rows; r++) {
      const std::uint16_t* region = band.region.data() + r * w;
      const bool last = band.first + r + 1 == texels_.height();
      diffusion.row(band.normals.data() + r * w, region, last ? nullptr : region + w, index.row(band.first + r));
    }
  }

  std::uint16_t region(int x, int y) const {
    return std::uint16_t(2 * group_[classes_.material_at(x, y)] + (classes_.counts_at(x, y) ? 1 : 0));
  }

  TexelKeys& texels_;
  const TexelClasses& classes_;
  const Histogram& histogram_;
  const Palette& palette_;
  const std::vector<EntryRange>& ranges_;
  const QuantizeOptions& options_;
  std::vector<std::uint16_t> group_;  // of a material id
  std::vector<std::uint16_t> nearest_;
};

}  // namespace

QuantizeResult quantize_normal_map(const FileRef& file, const QuantizeOptions& options, const Progress& progress) {
  check(options);
  TexelKeys texels(file, options.coding);
  std::optional<Palette> given;
  if (!options.palette.empty()) given = read_palette(options.palette, options.coding.green);
  if (given && options.space && given->space != *options.space)
    throw file_error(ErrorKind::kMalformed, options.palette.name,
                     std::string("expected a palette in ") + burnish::name(*options.space) + " space, got one in " +
                         burnish::name(given->space) + " space");
  TexelClasses classes;
  if (!options.material.empty()) classes.material = read_ids(options.material, texels.width(), texels.height());
  if (!options.mask.empty()) classes.mask = read_mask(options.mask, texels.width(), texels.height());
  const Histogram histogram = count_normals(texels, classes, part_of(progress, 0, 0.3));

  QuantizeResult result;
  result.map.palette = given ? std::move(*given)
                       : options.target_error_deg
                           ? fit_to_target(histogram, options, part_of(progress, 0.3, 0.8))
                           : to_palette(fit(histogram, options.engine, options.normals, part_of(progress, 0.3, 0.8)),
                                        histogram.material, options.space.value_or(NormalSpace::kTangent));
  const Palette& palette = result.map.palette;
  const std::vector<EntryRange> ranges =
      entry_ranges(palette, histogram.material, given ? options.palette.name : texels.name());
  result.map.levels.emplace_back(texels.width(), texels.height());
  const AngleStats angles =
      Mapper(texels, classes, histogram, palette, ranges, options).run(result.map.levels[0], part_of(progress, 0.8, 1));

  QuantizeStats& s = result.stats;
  s.texels = histogram.texels;
  s.normals = int(palette.normals.size());
  s.distinct_input_normals = histogram.distinct;
  s.invalid_texels = histogram.invalid_texels;
  s.rms_deg = angles.rms_deg(), s.mean_deg = angles.mean_deg(), s.p95_deg = angles.p95_deg(),
  s.max_deg = angles.max_deg();
  s.lossless = histogram.exact && s.max_deg == 0;
  return result;
}

}  // namespace burnish
