#include "burnish/palette/histogram.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "burnish/core/parallel.h"
#include "burnish/palette/normal_bins.h"

namespace burnish {
namespace {

constexpr std::size_t kMostDistinct = std::size_t(1) << 21;
constexpr int kLanes = 8;  // tables filled side by side; their number is fixed, the threads take them as they come
constexpr int kBandRows = 128;

// Calls body(lane, keys of the row, y) for every row, lanes in parallel, while the next band is read; stops where it
// returns false.
template <typename Body>
bool for_each_row(TexelKeys& texels, const Progress& progress, const Body& body) {
  const int w = texels.width(), h = texels.height();
  std::vector<std::uint64_t> keys(std::size_t(w) * std::min(h, kBandRows)), next(keys.size());
  std::array<bool, kLanes> go_on;
  go_on.fill(true);
  const auto read = [&](int y, std::vector<std::uint64_t>& to) {
    if (y < h) texels.read_rows(y, std::min(kBandRows, h - y), to.data());
  };
  read(0, keys);
  for (int y = 0; y < h; y += kBandRows) {
    const int rows = std::min(kBandRows, h - y);
    parallel_invoke([&] { read(y + kBandRows, next); },
                    [&] {
                      parallel_for(kLanes, [&](std::size_t lane) {
                        for (int r = int(lane) * rows / kLanes; r < int(lane + 1) * rows / kLanes && go_on[lane]; r++)
                          go_on[lane] = body(lane, keys.data() + std::size_t(r) * w, y + r);
                      });
                    });
    if (std::ranges::find(go_on, false) != go_on.end()) return false;
    std::swap(keys, next);
    report_progress(progress, double(y + rows) / h);
  }
  return true;
}

// Groups from (material, normal, count) in ascending order of material.
void make_groups(const std::vector<Histogram::Key>& keys, Histogram& out) {
  std::vector<char>& counts = out.counts;
  counts.resize(out.material.size());
  for (const Histogram::Key& k : keys) counts[k.group] |= k.count > 0;
  out.groups.resize(out.material.size());
  std::vector<Vec3d> masked(out.material.size());
  for (const Histogram::Key& k : keys) {
    if (k.count > 0) out.groups[k.group].push_back({k.normal, float(k.count)});
    else masked[k.group] += Vec3d(k.normal);
  }
  for (std::size_t i = 0; i < out.groups.size(); i++) {
    std::vector<WeightedNormal>& g = out.groups[i];
    if (!counts[i]) {
      g = {{length(masked[i]) > 1e-9 ? Vec3f(normalized(masked[i])) : Vec3f{0, 0, 1}, 1}};
      continue;
    }
    std::ranges::sort(g, [](const WeightedNormal& a, const WeightedNormal& b) {
      return std::tie(a.normal.x, a.normal.y, a.normal.z, a.weight) <
             std::tie(b.normal.x, b.normal.y, b.normal.z, b.weight);
    });
    std::size_t kept = 0;  // different codes can mean one normal
    for (const WeightedNormal& p : g) {
      if (kept && g[kept - 1].normal == p.normal) g[kept - 1].weight += p.weight;
      else g[kept++] = p;
    }
    g.resize(kept);
    out.distinct += kept;
  }
}

// Every distinct key, and how often it occurs in all maps together.
class ExactCounts {
 public:
  // False, and of no further use, where the keys have become too many.
  bool add(OpenMap& map, const Progress& progress, Histogram::Texels& texels) {
    std::array<KeyTable, kLanes> lanes;
    if (!count(map, progress, lanes)) return false;
    for (const KeyTable& lane : lanes) {
      place_.reserve(lane.size());
      lane.for_each([&](std::uint64_t key, std::uint32_t n) {
        std::uint32_t& place = place_[key];
        if (place == 0) {  // new
          Counted c{key, {}, 0, false};
          c.normal = map.texels.decode(key & ((std::uint64_t(1) << TexelKeys::kBits) - 1), c.invalid);
          counted_.push_back(c);
          place = std::uint32_t(counted_.size());
        }
        Counted& c = counted_[place - 1];
        c.texels += n;
        texels.counted += n;
        if (c.invalid) texels.invalid += n;
      });
      if (counted_.size() > kMostDistinct) return false;
    }
    return true;
  }

  // Material, table and keys of the histogram, in ascending order of the keys.
  void move_to(Histogram& out) {
    std::ranges::sort(counted_, {}, &Counted::key);
    out.keys.reserve(counted_.size());
    for (const Counted& c : counted_) {
      const int material = int(c.key >> TexelKeys::kBits);
      if (out.material.empty() || out.material.back() != material) out.material.push_back(material);
      place_[c.key] = std::uint32_t(out.keys.size());
      out.keys.push_back({int(out.material.size()) - 1, c.normal, c.texels});
    }
    out.table = std::move(place_);
  }

 private:
  static bool count(OpenMap& map, const Progress& progress, std::array<KeyTable, kLanes>& lanes) {
    const TexelClasses& classes = map.classes;
    const int w = map.texels.width();
    return for_each_row(map.texels, progress, [&](std::size_t lane, const std::uint64_t* keys, int y) {
      KeyTable& table = lanes[lane];
      for (int x = 0; x < w;) {
        const int material = classes.material_at(x, y);
        const bool counts = classes.counts_at(x, y);
        if (x + KeyTable::kAhead < w) table.prefetch(Histogram::key(material, keys[x + KeyTable::kAhead]));
        int end = x + 1;
        while (end < w && keys[end] == keys[x] && classes.material_at(end, y) == material &&
               classes.counts_at(end, y) == counts)
          end++;
        table[Histogram::key(material, keys[x])] += counts ? std::uint32_t(end - x) : 0;
        x = end;
      }
      return table.size() <= kMostDistinct;
    });
  }

  struct Counted {
    std::uint64_t key;
    Vec3f normal;
    std::uint64_t texels;
    bool invalid;
  };
  KeyTable place_;  // position in counted_ plus one
  std::vector<Counted> counted_;
};

void add_to_bins(OpenMap& map, const Progress& progress, NormalBins& bins, Histogram::Texels& texels) {
  std::array<NormalBins, kLanes> lanes;
  std::array<Histogram::Texels, kLanes> of_lane{};
  for_each_row(map.texels, progress, [&](std::size_t lane, const std::uint64_t* keys, int y) {
    for (int x = 0; x < map.texels.width(); x++) {
      bool invalid;
      const Vec3f n = map.texels.decode(keys[x], invalid);
      const bool counts = map.classes.counts_at(x, y);
      of_lane[lane].counted += counts;
      of_lane[lane].invalid += invalid && counts;
      lanes[lane].add(map.classes.material_at(x, y), counts, n);
    }
    return true;
  });
  for (const NormalBins& lane : lanes) bins.add(lane);
  for (const Histogram::Texels& t : of_lane) texels.counted += t.counted, texels.invalid += t.invalid;
}

Progress part_of_map(const Progress& progress, std::size_t i, const MapSet& maps) {
  return part_of(progress, double(i) / double(maps.size()), double(i + 1) / double(maps.size()));
}

bool count_exactly(MapSet& maps, const Progress& progress, Histogram& out) {
  ExactCounts counts;
  for (std::size_t i = 0; i < maps.size(); i++)
    if (!counts.add(maps.open(i), part_of_map(progress, i, maps), out.maps[i])) return false;
  counts.move_to(out);
  make_groups(out.keys, out);
  return true;
}

void count_in_bins(MapSet& maps, const Progress& progress, Histogram& out) {
  NormalBins bins;
  for (std::size_t i = 0; i < maps.size(); i++)
    add_to_bins(maps.open(i), part_of_map(progress, i, maps), bins, out.maps[i]);
  std::vector<Histogram::Key> keys;
  bins.for_each_sorted([&](int material, bool counts, Vec3f mean, std::uint64_t n) {
    if (out.material.empty() || out.material.back() != material) out.material.push_back(material);
    keys.push_back({int(out.material.size()) - 1, mean, counts ? n : 0});
  });
  out.exact = false;
  make_groups(keys, out);
}

}  // namespace

Histogram count_normals(MapSet& maps, const Progress& progress) {
  Histogram exact;
  exact.maps.resize(maps.size());
  if (count_exactly(maps, progress, exact)) return exact;
  Histogram binned;
  binned.maps.resize(maps.size());
  count_in_bins(maps, progress, binned);
  return binned;
}

}  // namespace burnish
