#include "burnish/palette/histogram.h"

#include <algorithm>
#include <tuple>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// The number of a material's group; materials come in ascending order.
int group_of(int material, Histogram& out) {
  if (out.material.empty() || out.material.back() != material) out.material.push_back(material);
  return int(out.material.size()) - 1;
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

}  // namespace

Histogram histogram_of(NormalCounts counts) {
  Histogram out;
  out.exact = counts.exact();
  std::vector<Histogram::Key> keys;
  if (counts.exact()) {
    const std::vector<NormalCounts::Key> sorted = counts.take_sorted_keys(out.table);
    for (const NormalCounts::Key& k : sorted) keys.push_back({group_of(k.material(), out), {}, k.texels});
    parallel_for_chunks(keys.size(), 4096, [&](std::size_t begin, std::size_t end, std::size_t) {
      bool invalid;
      for (std::size_t i = begin; i < end; i++) keys[i].normal = TexelKeys::decode(sorted[i].texel(), invalid);
    });
  } else {
    for (const NormalBins::Bin& b : counts.bins().sorted())
      keys.push_back({group_of(b.material(), out), b.mean(), b.counts() ? b.sum.texels : 0});
  }
  make_groups(keys, out);
  if (out.exact) out.keys = std::move(keys);
  return out;
}

Histogram count_normals(MapSet& maps, const Progress& progress) {
  NormalCounts counts;
  std::vector<NormalCounts::Texels> of_maps = counts.add(maps, progress);
  Histogram out = histogram_of(std::move(counts));
  out.maps = std::move(of_maps);
  return out;
}

}  // namespace burnish
