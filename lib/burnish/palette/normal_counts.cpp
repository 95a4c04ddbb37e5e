#include "burnish/palette/normal_counts.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// Tables filled side by side; their number is fixed, the threads take them as they come. Bins take more memory.
constexpr int kLanes = 8, kBinLanes = 2;

int rows_of_band(int width) {
  constexpr std::size_t kTexels = std::size_t(1) << 20;
  return int(std::clamp<std::size_t>(kTexels / width, 2 * kLanes, 128));
}

// Calls body(rows) for each band of rows, while the next is read.
template <typename Body>
void for_each_band(OpenMap& map, const Progress& progress, const Body& body) {
  const int h = map.height(), band = rows_of_band(map.width());
  TexelRows rows, next;
  const auto read = [&](int y, TexelRows& to) {
    if (y < h) map.read_rows(y, std::min(band, h - y), to);
  };
  read(0, rows);
  for (int y = 0; y < h; y += band) {
    parallel_invoke([&] { read(y + band, next); }, [&] { body(rows); });
    report_progress(progress, double(y + rows.count) / h);
    std::swap(rows, next);
  }
}

// Calls body(lane, y) for each row y, the lanes side by side.
template <typename Lanes, typename Body>
void for_each_row(const TexelRows& rows, Lanes& lanes, const Body& body) {
  const int count = int(lanes.size());
  parallel_for(lanes.size(), [&](std::size_t lane) {
    for (int y = int(lane) * rows.count / count; y < int(lane + 1) * rows.count / count; y++) body(lanes[lane], y);
  });
}

}  // namespace

struct NormalCounts::Lane {
  KeyTable counted, masked;  // texels of each key
};

struct NormalCounts::BinLane {
  NormalBins bins;
  Texels texels;
};

NormalCounts::NormalCounts(NormalBins bins, std::uint64_t invalid) : bins_(std::move(bins)) {
  texels_.invalid = invalid;
  for (const NormalBins::Bin& b : bins_->sorted())
    if (b.counts()) texels_.counted += b.sum.texels;
}

std::vector<NormalCounts::Texels> NormalCounts::add(MapSet& maps, const Progress& progress) {
  std::vector<Texels> of_maps;
  for (std::size_t i = 0; i < maps.size(); i++) {
    const double from = double(i) / double(maps.size()), to = double(i + 1) / double(maps.size());
    of_maps.push_back(add(maps.open(i), part_of(progress, from, to)));
    if (of_maps.back().counted == 0)
      throw file_error(
          ErrorKind::kMalformed, maps.files(i).mask.name,
          "expected texels that are not 0, got none: it masks every texel of '" + maps.files(i).normals.name + "'");
  }
  return of_maps;
}

NormalCounts::Texels NormalCounts::add(OpenMap& map, const Progress& progress) {
  const Texels before = texels_;
  std::vector<Lane> lanes(kLanes);
  std::vector<BinLane> bin_lanes;
  for_each_band(map, progress, [&](const TexelRows& rows) {
    if (bins_) {
      if (bin_lanes.empty()) bin_lanes.resize(kBinLanes, {NormalBins(bins_->shift()), {}});
      return count_in_bins(rows, bin_lanes);
    }
    count(rows, lanes);
    std::size_t keys = 0;
    for (const Lane& lane : lanes) keys += lane.counted.size() + lane.masked.size();
    if (keys > kMostKeys) take(lanes);
  });
  take(lanes);
  for (BinLane& lane : bin_lanes) {
    bins_->add(lane.bins);
    texels_.counted += lane.texels.counted, texels_.invalid += lane.texels.invalid;
    lane.bins = NormalBins();
  }
  return {texels_.counted - before.counted, texels_.invalid - before.invalid};
}

void NormalCounts::add(const NormalCounts& other) {
  if (other.exact()) {
    if (!bins_) place_.reserve(other.keys_.size());
    for (const Key& key : other.keys_) add(key);
    return;
  }
  if (!bins_) change_to_bins();
  bins_->add(*other.bins_);
  texels_.counted += other.texels_.counted, texels_.invalid += other.texels_.invalid;
}

void NormalCounts::add(const Key& key) {
  std::uint32_t place = 0;
  bool invalid;
  if (!bins_) {
    std::uint32_t& known = place_[key.key];
    if (known == 0 && keys_.size() < kMostKeys) {  // new
      TexelKeys::decode(key.texel(), invalid);
      keys_.push_back({key.key, 0, 0, invalid});
      known = std::uint32_t(keys_.size());
    }
    if ((place = known) == 0) change_to_bins();
  }
  if (place > 0) {
    Key& k = keys_[place - 1];
    k.texels += key.texels, k.masked += key.masked;
    invalid = k.invalid;
  } else {
    invalid = add_to_bins(key);
  }
  texels_.counted += key.texels;
  if (invalid) texels_.invalid += key.texels;
}

std::vector<NormalCounts::Key> NormalCounts::take_sorted_keys(KeyTable& numbers) {
  std::ranges::sort(keys_, {}, &Key::key);
  for (std::size_t i = 0; i < keys_.size(); i++) place_[keys_[i].key] = std::uint32_t(i);
  numbers = std::move(place_);
  return std::move(keys_);
}

void NormalCounts::count(const TexelRows& rows, std::vector<Lane>& lanes) {
  for_each_row(rows, lanes, [&](Lane& lane, int y) {
    const std::uint64_t* keys = rows.row(y);
    for (int x = 0; x < rows.width;) {
      const int material = rows.material_at(x, y);
      const bool counts = rows.counts_at(x, y);
      KeyTable& table = counts ? lane.counted : lane.masked;
      if (x + KeyTable::kAhead < rows.width) table.prefetch(key(material, keys[x + KeyTable::kAhead]));
      int end = x + 1;
      while (end < rows.width && keys[end] == keys[x] && rows.material_at(end, y) == material &&
             rows.counts_at(end, y) == counts)
        end++;
      table[key(material, keys[x])] += std::uint32_t(end - x);
      x = end;
    }
  });
}

void NormalCounts::take(std::vector<Lane>& lanes) {
  for (Lane& lane : lanes) {
    if (!bins_) place_.reserve(std::max(lane.counted.size(), lane.masked.size()));
    lane.counted.for_each([&](std::uint64_t key, std::uint32_t n) { add({key, n, 0}); });
    lane.masked.for_each([&](std::uint64_t key, std::uint32_t n) { add({key, 0, n}); });
    lane = {};
  }
}

void NormalCounts::count_in_bins(const TexelRows& rows, std::vector<BinLane>& lanes) {
  for_each_row(rows, lanes, [&](BinLane& lane, int y) {
    for (int x = 0; x < rows.width; x++) {
      bool invalid;
      const Vec3f n = TexelKeys::decode(rows.row(y)[x], invalid);
      const bool counts = rows.counts_at(x, y);
      lane.texels.counted += counts;
      lane.texels.invalid += invalid && counts;
      lane.bins.add(rows.material_at(x, y), counts, n);
    }
  });
}

void NormalCounts::change_to_bins() {
  bins_.emplace();
  for (const Key& k : keys_) add_to_bins(k);
  keys_ = {}, place_ = {};
}

// Whether it is invalid.
bool NormalCounts::add_to_bins(const Key& key) {
  bool invalid;
  const Vec3f normal = TexelKeys::decode(key.texel(), invalid);
  if (key.texels > 0) bins_->add(key.material(), true, normal, key.texels);
  if (key.masked > 0) bins_->add(key.material(), false, normal, key.masked);
  return invalid;
}

}  // namespace burnish
