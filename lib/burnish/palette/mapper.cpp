#include "burnish/palette/mapper.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// Of a chunk of a sum; of wide maps fewer, so that all threads have some.
std::size_t rows_of_sum(int width) {
  constexpr std::size_t kTexels = std::size_t(1) << 18;
  return std::clamp<std::size_t>(kTexels / width, 1, 64);
}

// Of a band: enough for all threads, and of wide maps no more than it takes.
int rows_of_band(int width, Dither dither) {
  constexpr std::size_t kTexels = std::size_t(1) << 22;
  const std::size_t step = dither == Dither::kBlueNoise ? kDotBandRows : 1;
  return int(step * std::clamp<std::size_t>(kTexels / step / width, 1, 512 / step));
}

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

// Rows, and the regions of their texels and of those of the row below.
struct Mapper::Band {
  int width, rows;
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

AngleStats Mapper::run(OpenMap& map, const IndexRowSink& sink, const Progress& progress) const {
  const int w = map.width(), h = map.height(), band = rows_of_band(w, dither_);
  TexelRows here, below, ahead;  // below: that error diffusion may look down
  std::vector<std::uint16_t> made, written;
  const auto read = [&](int y, TexelRows& to) {
    if (y < h) map.read_rows(y, std::min(band, h - y), to);
  };
  const auto write = [&] {
    if (!written.empty()) sink(int(written.size() / w), written.data());
  };
  ErrorDiffusion diffusion(palette_.normals, ranges_of_regions_, w, amount_);
  AngleStats angles;
  read(0, here);
  read(band, below);
  for (int y = 0; y < h; y += band) {
    made.resize(std::size_t(w) * here.count);
    const auto map_band = [&] {
      angles += nearest_.empty() ? search(here, y + band < h ? &below : nullptr, diffusion, made.data())
                                 : look_up(here, made.data());
    };
    parallel_invoke([&] { read(y + 2 * band, ahead); }, [&] { parallel_invoke(write, map_band); });
    std::swap(made, written);
    report_progress(progress, double(y + here.count) / h);
    std::swap(here, below);
    std::swap(below, ahead);
  }
  write();
  return nearest_.empty() || !angle_.empty() ? angles : nearest_angles(histogram_, palette_, ranges_);
}

AngleStats Mapper::look_up(const TexelRows& rows, std::uint16_t* out) const {
  return parallel_sum<AngleStats>(rows.count, rows_of_sum(rows.width), [&](std::size_t begin, std::size_t end) {
    AngleStats s;
    for (std::size_t y = begin; y < end; y++) look_up_row(rows, int(y), out + y * rows.width, s);
    return s;
  });
}

void Mapper::look_up_row(const TexelRows& rows, int y, std::uint16_t* out, AngleStats& angles) const {
  const std::uint64_t* keys = rows.row(y);
  std::uint64_t last = ~std::uint64_t(0);
  std::uint32_t at = 0;
  for (int x = 0; x < rows.width; x++) {
    const int material = rows.material_at(x, y);
    if (x + KeyTable::kAhead < rows.width)
      histogram_.table.prefetch(Histogram::key(material, keys[x + KeyTable::kAhead]));
    if (const std::uint64_t key = Histogram::key(material, keys[x]); key != last)
      at = histogram_.table.at(key), last = key;
    out[x] = nearest_[at];
    if (!angle_.empty() && rows.counts_at(x, y)) angles.add(angle_[at]);
  }
}

AngleStats Mapper::search(const TexelRows& rows, const TexelRows* below, ErrorDiffusion& diffusion,
                          std::uint16_t* out) const {
  const std::size_t w = rows.width;
  const Band band = decode(rows, below);
  switch (dither_) {
    case Dither::kDiffusion:
      for (int r = 0; r < rows.count; r++) {
        const std::uint16_t* region = band.region.data() + r * w;
        diffusion.row(band.normals.data() + r * w, region, r + 1 == rows.count && !below ? nullptr : region + w,
                      out + r * w);
      }
      break;
    case Dither::kBlueNoise:
      parallel_for_chunks(rows.count, kDotBandRows, [&](std::size_t begin, std::size_t end, std::size_t) {
        diffuse_dots(palette_.normals, ranges_of_regions_, int(w), int(end - begin), band.normals.data() + begin * w,
                     band.region.data() + begin * w, amount_, out + begin * w);
      });
      break;
    case Dither::kNone:
      parallel_for(rows.count, [&](std::size_t r) { nearest_row(band, r, out + r * w); });
  }
  return parallel_sum<AngleStats>(rows.count, rows_of_sum(rows.width), [&](std::size_t begin, std::size_t end) {
    AngleStats s;
    for (std::size_t i = begin * w; i < end * w; i++)
      if (band.region[i] % 2) s.add(angle_to(band.normals[i], palette_.normals[out[i]]));
    return s;
  });
}

Mapper::Band Mapper::decode(const TexelRows& rows, const TexelRows* below) const {
  const std::size_t w = rows.width, regions = rows.count + (below ? 1 : 0);
  Band band{rows.width, rows.count, std::vector<Vec3f>(w * rows.count), std::vector<std::uint16_t>(w * regions)};
  parallel_for(regions, [&](std::size_t r) {
    if (int(r) == rows.count) {
      for (std::size_t x = 0; x < w; x++) band.region[r * w + x] = region(*below, int(x), 0);
      return;
    }
    bool invalid;
    for (std::size_t i = r * w; i < (r + 1) * w; i++) band.normals[i] = TexelKeys::decode(rows.keys[i], invalid);
    for (std::size_t x = 0; x < w; x++) band.region[r * w + x] = region(rows, int(x), int(r));
  });
  return band;
}

void Mapper::nearest_row(const Band& band, std::size_t row, std::uint16_t* out) const {
  const std::size_t w = band.width;
  for (std::size_t x = 0; x < w; x++) {
    const EntryRange& range = *ranges_of_regions_[band.region[row * w + x]];
    out[x] = std::uint16_t(range.first + range.nearest(band.normals[row * w + x]));
  }
}

std::uint16_t Mapper::region(const TexelRows& rows, int x, int y) const {
  return std::uint16_t(2 * group_[rows.material_at(x, y)] + (rows.counts_at(x, y) ? 1 : 0));
}

}  // namespace burnish
