#include "burnish/palette/mapper.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr int kRows = 4 * kDotBandRows;  // of a band
constexpr std::size_t kRowsOfSum = 64;

double angle_to(Vec3f normal, Vec3f entry) { return angle_rad(Vec3d(normal), Vec3d(entry)); }

}  // namespace

std::vector<EntryRange> entry_ranges(const Palette& palette, const std::vector<int>& materials,
                                     const std::string& palette_name) {
  std::vector<EntryRange> ranges;
  for (int id : materials) {
    const auto m = std::ranges::find(palette.materials, id, &MaterialInterval::id);
    if (m == palette.materials.end()) {
      std::string has;
      for (const MaterialInterval& i : palette.materials) has += (has.empty() ? "" : ", ") + std::to_string(i.id);
      throw file_error(ErrorKind::kMalformed, palette_name,
                       "expected entries for material " + std::to_string(id) + ", got " + has);
    }
    ranges.push_back({m->first, NearestEntry(std::span(palette.normals).subspan(m->first, m->count))});
  }
  return ranges;
}

AngleStats nearest_angles(const Histogram& histogram, const Palette& palette, const std::vector<EntryRange>& ranges) {
  AngleStats total;
  for (std::size_t g = 0; g < histogram.groups.size(); g++) {
    if (!histogram.counts[g]) continue;
    const std::vector<WeightedNormal>& points = histogram.groups[g];
    total += parallel_sum<AngleStats>(points.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
      AngleStats s;
      for (std::size_t i = begin; i < end; i++)
        s.add(angle_to(points[i].normal, palette.normals[ranges[g].first + ranges[g].nearest(points[i].normal)]),
              std::uint64_t(points[i].weight));
      return s;
    });
  }
  return total;
}

// A band of rows, and the region of the row below it.
struct Mapper::Band {
  int first, rows;
  std::vector<Vec3f> normals;
  std::vector<std::uint16_t> region;
};

Mapper::Mapper(const Histogram& histogram, const Palette& palette, const std::string& palette_name, Dither dither,
               double amount)
    : histogram_(histogram),
      palette_(palette),
      ranges_(entry_ranges(palette, histogram.material, palette_name)),
      dither_(dither),
      amount_(amount),
      group_(256) {
  for (std::size_t g = 0; g < histogram.material.size(); g++) group_[histogram.material[g]] = std::uint16_t(g);
  for (const EntryRange& r : ranges_) ranges_of_regions_.insert(ranges_of_regions_.end(), 2, &r);
  if (!histogram.exact || dither != Dither::kNone) return;
  nearest_.resize(histogram.keys.size());
  // The angles of a single map follow from its distinct normals, which are fewer than its texels.
  if (histogram.maps.size() > 1) angle_.resize(histogram.keys.size());
  parallel_for_chunks(histogram.keys.size(), 4096, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) {
      const Histogram::Key& k = histogram.keys[i];
      nearest_[i] = std::uint16_t(ranges_[k.group].first + ranges_[k.group].nearest(k.normal));
      if (!angle_.empty()) angle_[i] = angle_to(k.normal, palette.normals[nearest_[i]]);
    }
  });
}

AngleStats Mapper::run(OpenMap& map, IndexImage& index, const Progress& progress) {
  return nearest_.empty() ? search(map, index, progress) : look_up(map, index, progress);
}

AngleStats Mapper::look_up(OpenMap& map, IndexImage& index, const Progress& progress) const {
  const int w = map.texels.width(), h = map.texels.height();
  AngleStats angles;
  std::vector<std::uint64_t> keys(std::size_t(w) * std::min(h, kRows));
  for (int y0 = 0; y0 < h; y0 += kRows) {
    const int rows = std::min(kRows, h - y0);
    map.texels.read_rows(y0, rows, keys.data());
    angles += parallel_sum<AngleStats>(rows, kRowsOfSum, [&](std::size_t begin, std::size_t end) {
      AngleStats s;
      for (std::size_t r = begin; r < end; r++)
        look_up_row(map, y0 + int(r), keys.data() + r * w, index.row(y0 + int(r)), s);
      return s;
    });
    report_progress(progress, double(y0 + rows) / h);
  }
  return angle_.empty() ? nearest_angles(histogram_, palette_, ranges_) : angles;
}

void Mapper::look_up_row(const OpenMap& map, int y, const std::uint64_t* keys, std::uint16_t* out,
                         AngleStats& angles) const {
  const TexelClasses& classes = map.classes;
  const int w = map.texels.width();
  std::uint64_t last = ~std::uint64_t(0);
  std::uint32_t at = 0;
  for (int x = 0; x < w; x++) {
    const int material = classes.material_at(x, y);
    if (x + KeyTable::kAhead < w) histogram_.table.prefetch(Histogram::key(material, keys[x + KeyTable::kAhead]));
    if (const std::uint64_t key = Histogram::key(material, keys[x]); key != last)
      at = histogram_.table.at(key), last = key;
    out[x] = nearest_[at];
    if (!angle_.empty() && classes.counts_at(x, y)) angles.add(angle_[at]);
  }
}

AngleStats Mapper::search(OpenMap& map, IndexImage& index, const Progress& progress) const {
  const int w = map.texels.width(), h = map.texels.height();
  ErrorDiffusion diffusion(palette_.normals, ranges_of_regions_, w, amount_);
  AngleStats angles;
  std::vector<std::uint64_t> keys(std::size_t(w) * std::min(h, kRows));
  for (int y0 = 0; y0 < h; y0 += kRows) {
    const int rows = std::min(kRows, h - y0);
    map.texels.read_rows(y0, rows, keys.data());
    const Band band = decode(map, y0, rows, keys.data());
    switch (dither_) {
      case Dither::kDiffusion:
        for (int r = 0; r < rows; r++) {
          const std::uint16_t* region = band.region.data() + std::size_t(r) * w;
          diffusion.row(band.normals.data() + std::size_t(r) * w, region, y0 + r + 1 == h ? nullptr : region + w,
                        index.row(y0 + r));
        }
        break;
      case Dither::kBlueNoise:
        parallel_for_chunks(rows, kDotBandRows, [&](std::size_t begin, std::size_t end, std::size_t) {
          diffuse_dots(palette_.normals, ranges_of_regions_, w, int(end - begin), band.normals.data() + begin * w,
                       band.region.data() + begin * w, amount_, index.row(y0 + int(begin)));
        });
        break;
      case Dither::kNone:
        parallel_for(rows, [&](std::size_t r) { nearest_row(band, r, index.row(y0 + int(r))); });
    }
    angles += parallel_sum<AngleStats>(rows, kRowsOfSum, [&](std::size_t begin, std::size_t end) {
      AngleStats s;
      for (std::size_t i = begin * w; i < end * w; i++)
        if (band.region[i] % 2) s.add(angle_to(band.normals[i], palette_.normals[index.data[std::size_t(y0) * w + i]]));
      return s;
    });
    report_progress(progress, double(y0 + rows) / h);
  }
  return angles;
}

Mapper::Band Mapper::decode(const OpenMap& map, int first_row, int rows, const std::uint64_t* keys) const {
  const std::size_t w = map.texels.width();
  const int region_rows = std::min(rows + 1, map.texels.height() - first_row);
  Band band{first_row, rows, std::vector<Vec3f>(w * rows), std::vector<std::uint16_t>(w * region_rows)};
  parallel_for(rows, [&](std::size_t r) {
    bool invalid;
    for (std::size_t i = r * w; i < (r + 1) * w; i++) band.normals[i] = map.texels.decode(keys[i], invalid);
  });
  parallel_for(region_rows, [&](std::size_t r) {
    for (std::size_t x = 0; x < w; x++) band.region[r * w + x] = region(map.classes, int(x), first_row + int(r));
  });
  return band;
}

void Mapper::nearest_row(const Band& band, std::size_t row, std::uint16_t* out) const {
  const std::size_t w = band.normals.size() / band.rows;
  for (std::size_t x = 0; x < w; x++) {
    const EntryRange& range = *ranges_of_regions_[band.region[row * w + x]];
    out[x] = std::uint16_t(range.first + range.nearest(band.normals[row * w + x]));
  }
}

std::uint16_t Mapper::region(const TexelClasses& classes, int x, int y) const {
  return std::uint16_t(2 * group_[classes.material_at(x, y)] + (classes.counts_at(x, y) ? 1 : 0));
}

}  // namespace burnish
