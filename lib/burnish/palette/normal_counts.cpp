#include "burnish/palette/normal_counts.h"

#include <algorithm>
#include <array>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr int kLanes = 8;  // tables filled side by side; their number is fixed, the threads take them as they come
constexpr int kBandRows = 128;

// Calls body(lane, rows, y) for each row y of each band of rows, lanes in parallel, while the next band is read; stops
// where it returns false.
template <typename Body>
bool for_each_row(OpenMap& map, const Progress& progress, const Body& body) {
  const int h = map.height();
  TexelRows rows, next;
  std::array<bool, kLanes> go_on;
  go_on.fill(true);
  const auto read = [&](int y, TexelRows& to) {
    if (y < h) map.read_rows(y, std::min(kBandRows, h - y), to);
  };
  read(0, rows);
  for (int y = 0; y < h; y += kBandRows) {
    parallel_invoke([&] { read(y + kBandRows, next); },
                    [&] {
                      parallel_for(kLanes, [&](std::size_t lane) {
                        const int end = int(lane + 1) * rows.count / kLanes;
                        for (int r = int(lane) * rows.count / kLanes; r < end && go_on[lane]; r++)
                          go_on[lane] = body(lane, rows, r);
                      });
                    });
    if (std::ranges::find(go_on, false) != go_on.end()) return false;
    report_progress(progress, double(y + rows.count) / h);
    std::swap(rows, next);
  }
  return true;
}

}  // namespace

struct NormalCounts::Lane {
  KeyTable counted, masked;  // texels of each key
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
  std::vector<Lane> lanes(bins_ ? 0 : kLanes);
  if (bins_ || !count(map, progress, lanes)) {
    if (!bins_) change_to_bins();
    lanes.clear();
    count_in_bins(map, progress);
  }
  for (const Lane& lane : lanes) {
    place_.reserve(std::max(lane.counted.size(), lane.masked.size()));
    lane.counted.for_each([&](std::uint64_t key, std::uint32_t n) { add({key, n, 0}); });
    lane.masked.for_each([&](std::uint64_t key, std::uint32_t n) { add({key, 0, n}); });
  }
  return {texels_.counted - before.counted, texels_.invalid - before.invalid};
}

void NormalCounts::add(const NormalCounts& other) {
  if (other.exact()) {
    place_.reserve(other.keys_.size());
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

// False, with lanes of no further use, where the keys are too many to be kept.
bool NormalCounts::count(OpenMap& map, const Progress& progress, std::vector<Lane>& lanes) {
  const int w = map.width();
  return for_each_row(map, progress, [&](std::size_t number, const TexelRows& rows, int y) {
    const std::uint64_t* keys = rows.row(y);
    Lane& lane = lanes[number];
    for (int x = 0; x < w;) {
      const int material = rows.material_at(x, y);
      const bool counts = rows.counts_at(x, y);
      KeyTable& table = counts ? lane.counted : lane.masked;
      if (x + KeyTable::kAhead < w) table.prefetch(key(material, keys[x + KeyTable::kAhead]));
      int end = x + 1;
      while (end < w && keys[end] == keys[x] && rows.material_at(end, y) == material &&
             rows.counts_at(end, y) == counts)
        end++;
      table[key(material, keys[x])] += std::uint32_t(end - x);
      x = end;
    }
    return std::max(lane.counted.size(), lane.masked.size()) <= kMostKeys;
  });
}

void NormalCounts::count_in_bins(OpenMap& map, const Progress& progress) {
  std::array<NormalBins, kLanes> lanes;
  std::array<Texels, kLanes> of_lane{};
  for_each_row(map, progress, [&](std::size_t lane, const TexelRows& rows, int y) {
    for (int x = 0; x < rows.width; x++) {
      bool invalid;
      const Vec3f n = TexelKeys::decode(rows.row(y)[x], invalid);
      const bool counts = rows.counts_at(x, y);
      of_lane[lane].counted += counts;
      of_lane[lane].invalid += invalid && counts;
      lanes[lane].add(rows.material_at(x, y), counts, n);
    }
    return true;
  });
  for (const NormalBins& lane : lanes) bins_->add(lane);
  for (const Texels& t : of_lane) texels_.counted += t.counted, texels_.invalid += t.invalid;
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
