#include "burnish/palette/histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "burnish/core/parallel.h"
#include "burnish/palette/octahedral.h"

namespace burnish {
namespace {

constexpr std::size_t kMostDistinct = std::size_t(1) << 21;
constexpr std::size_t kMostBins = std::size_t(1) << 20;
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

// Groups from (material, normal, count) in ascending order of material. A material that is masked out whole still needs
// entries: its texels then count once each.
void make_groups(const std::vector<Histogram::Key>& keys, Histogram& out) {
  std::vector<char>& counts = out.counts;
  counts.resize(out.material.size());
  for (const Histogram::Key& k : keys) counts[k.group] |= k.count > 0;
  out.groups.resize(out.material.size());
  for (const Histogram::Key& k : keys)
    if (k.count > 0 || !counts[k.group]) out.groups[k.group].push_back({k.normal, float(std::max(k.count, 1u))});
  for (std::size_t i = 0; i < out.groups.size(); i++) {
    std::vector<WeightedNormal>& g = out.groups[i];
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
    if (counts[i]) out.distinct += kept;
  }
}

bool count_exactly(TexelKeys& texels, const TexelClasses& classes, const Progress& progress, Histogram& out) {
  std::array<KeyTable, kLanes> lanes;
  const int w = texels.width();
  const bool complete = for_each_row(texels, progress, [&](std::size_t lane, const std::uint64_t* keys, int y) {
    KeyTable& table = lanes[lane];
    for (int x = 0; x < w;) {
      const int material = classes.material_at(x, y);
      const bool counts = classes.counts_at(x, y);
      if (x + KeyTable::kAhead < w) table.prefetch(std::uint64_t(material) << 48 | keys[x + KeyTable::kAhead]);
      int end = x + 1;
      while (end < w && keys[end] == keys[x] && classes.material_at(end, y) == material &&
             classes.counts_at(end, y) == counts)
        end++;
      table[std::uint64_t(material) << 48 | keys[x]] += counts ? std::uint32_t(end - x) : 0;
      x = end;
    }
    return table.size() <= kMostDistinct;
  });
  if (!complete) return false;
  KeyTable counts;
  for (const KeyTable& lane : lanes) {
    counts.reserve(lane.size());
    lane.for_each([&](std::uint64_t key, std::uint32_t n) { counts[key] += n; });
    if (counts.size() > kMostDistinct) return false;
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
  sorted.reserve(counts.size());
  counts.for_each([&](std::uint64_t key, std::uint32_t n) { sorted.emplace_back(key, n); });
  std::ranges::sort(sorted);

  for (const auto& [key, n] : sorted) {
    const int material = int(key >> 48);
    if (out.material.empty() || out.material.back() != material) out.material.push_back(material);
    bool invalid;
    const Vec3f normal = texels.decode(key & ((std::uint64_t(1) << 48) - 1), invalid);
    if (invalid) out.invalid_texels += n;
    out.table[key] = std::uint32_t(out.keys.size());
    out.keys.push_back({int(out.material.size()) - 1, normal, n});
    out.texels += n;
  }
  make_groups(out.keys, out);
  return true;
}

// Bins of normals with integer sums, made coarser whenever they are too many.
class Bins {
 public:
  void add(int material, bool counts, Vec3f n) {
    const Vec3d v(n);
    add(std::uint64_t(material) << 40 | std::uint64_t(counts) << 32 | pack_octahedral(v, kBits),
        {std::llround(v.x * kUnit), std::llround(v.y * kUnit), std::llround(v.z * kUnit), 1});
  }
  void add(const Bins& other) {
    while (shift_ < other.shift_) coarsen();
    place_.reserve(other.place_.size());
    other.place_.for_each([&](std::uint64_t key, std::uint32_t place) { add(key, other.sums_[place - 1]); });
  }
  // body(material, counts, mean normal, texels), in ascending order of material.
  template <typename Body>
  void for_each_sorted(const Body& body) const {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { sorted.emplace_back(key, place); });
    std::ranges::sort(sorted);
    for (const auto& [key, place] : sorted) {
      const Sum& s = sums_[place - 1];
      const Vec3d v{double(s.x), double(s.y), double(s.z)};
      body(int(key >> 40), (key >> 32 & 1) != 0, length(v) > 0 ? Vec3f(normalized(v)) : Vec3f{0, 0, 1}, s.texels);
    }
  }

 private:
  static constexpr int kBits = 16;
  static constexpr double kUnit = 1 << 26;
  struct Sum {
    std::int64_t x, y, z;
    std::uint32_t texels;
  };

  void add(std::uint64_t key, const Sum& s) {
    const std::uint64_t low = 0xffffu >> shift_ << shift_;
    std::uint32_t& place = place_[key & (~std::uint64_t(0xffffffffu) | low << 16 | low)];
    if (place == 0) {  // new
      sums_.push_back({});
      place = std::uint32_t(sums_.size());
    }
    Sum& t = sums_[place - 1];
    t.x += s.x, t.y += s.y, t.z += s.z, t.texels += s.texels;
    if (sums_.size() > kMostBins) coarsen();
  }
  void coarsen() {
    Bins next;
    next.shift_ = shift_ + 1;
    next.place_.reserve(place_.size());
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { next.add(key, sums_[place - 1]); });
    *this = std::move(next);
  }

  int shift_ = 0;
  KeyTable place_;  // position in sums_ plus one
  std::vector<Sum> sums_;
};

void count_in_bins(TexelKeys& texels, const TexelClasses& classes, const Progress& progress, Histogram& out) {
  std::array<Bins, kLanes> lanes;
  std::array<std::size_t, kLanes> invalid{};
  for_each_row(texels, progress, [&](std::size_t lane, const std::uint64_t* keys, int y) {
    for (int x = 0; x < texels.width(); x++) {
      bool bad;
      const Vec3f n = texels.decode(keys[x], bad);
      const bool counts = classes.counts_at(x, y);
      invalid[lane] += bad && counts;
      lanes[lane].add(classes.material_at(x, y), counts, n);
    }
    return true;
  });
  Bins bins;
  for (const Bins& lane : lanes) bins.add(lane);
  for (std::size_t n : invalid) out.invalid_texels += n;
  std::vector<Histogram::Key> keys;
  bins.for_each_sorted([&](int material, bool counts, Vec3f mean, std::uint32_t n) {
    if (out.material.empty() || out.material.back() != material) out.material.push_back(material);
    keys.push_back({int(out.material.size()) - 1, mean, counts ? n : 0});
    if (counts) out.texels += n;
  });
  out.exact = false;
  make_groups(keys, out);
}

}  // namespace

Histogram count_normals(TexelKeys& texels, const TexelClasses& classes, const Progress& progress) {
  Histogram exact;
  if (count_exactly(texels, classes, progress, exact)) return exact;
  Histogram binned;
  count_in_bins(texels, classes, progress, binned);
  return binned;
}

}  // namespace burnish
