#include "burnish/palette/fit/point_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// Direction of largest variance of the points about their mean, by power iteration; any unit vector where they
// coincide.
Vec3d principal_axis(std::span<const WeightedNormal> range, Vec3d mean) {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const WeightedNormal& p : range) {
    const Vec3d d = Vec3d(p.normal) - mean;
    const double w = p.weight;
    xx += w * d.x * d.x, xy += w * d.x * d.y, xz += w * d.x * d.z;
    yy += w * d.y * d.y, yz += w * d.y * d.z, zz += w * d.z * d.z;
  }
  Vec3d axis = xx >= yy && xx >= zz ? Vec3d{1, 0, 0} : yy >= zz ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  for (int i = 0; i < 8; i++) {
    const Vec3d next{xx * axis.x + xy * axis.y + xz * axis.z, xy * axis.x + yy * axis.y + yz * axis.z,
                     xz * axis.x + yz * axis.y + zz * axis.z};
    const double l = length(next);
    if (!(l > 0)) break;
    axis = next / l;
  }
  return axis;
}

struct Sum {
  Vec3d sum;
  double weight = 0;
  void add(const WeightedNormal& p) { sum += Vec3d(p.normal) * double(p.weight), weight += p.weight; }
  void add(const Sum& s) { sum += s.sum, weight += s.weight; }
};

Sum sum_of(std::span<const WeightedNormal> range) {
  Sum s;
  for (const WeightedNormal& p : range) s.add(p);
  return s;
}

}  // namespace

// The squared chords from unit points to the centroid S/|S| sum up to 2(W − |S|): the cut that leaves least has most
// |S₁| + |S₂|.
int cut_in_two(std::span<WeightedNormal> range, double* saved) {
  const int n = int(range.size());
  const Sum all = sum_of(range);
  const Vec3f axis(principal_axis(range, all.sum / all.weight));
  const double whole = length(all.sum);
  *saved = 0;

  constexpr int kSortBelow = 1024;
  if (n < kSortBelow) {
    std::ranges::sort(range, [&](const WeightedNormal& a, const WeightedNormal& b) {
      const float pa = dot(a.normal, axis), pb = dot(b.normal, axis);
      if (pa != pb) return pa < pb;
      return a.normal.x != b.normal.x ? a.normal.x < b.normal.x : a.normal.y < b.normal.y;
    });
    int cut = n / 2;
    double best = 0;
    Sum low;
    for (int i = 0; i + 1 < n; i++) {
      low.add(range[i]);
      const double score = length(low.sum) + length(all.sum - low.sum);
      if (score > best) best = score, cut = i + 1;
    }
    *saved = std::max(0.0, 2 * (best - whole));
    return cut;
  }

  float lo = 2, hi = -2;
  for (const WeightedNormal& p : range) {
    const float t = dot(p.normal, axis);
    lo = std::min(lo, t), hi = std::max(hi, t);
  }
  if (!(hi > lo)) return n / 2;
  constexpr int kBins = 256;
  Sum bins[kBins];
  const float scale = float(kBins) / (hi - lo);
  const auto bin_of = [&](const WeightedNormal& p) {
    return std::min(kBins - 1, int((dot(p.normal, axis) - lo) * scale));
  };
  for (const WeightedNormal& p : range) bins[bin_of(p)].add(p);
  Sum low;
  double best = 0;
  int last_low = 0;
  for (int b = 0; b + 1 < kBins; b++) {
    low.add(bins[b]);
    if (low.weight == 0) continue;
    const double score = length(low.sum) + length(all.sum - low.sum);
    if (score > best) best = score, last_low = b;
  }
  *saved = std::max(0.0, 2 * (best - whole));
  const auto high =
      std::stable_partition(range.begin(), range.end(), [&](const WeightedNormal& p) { return bin_of(p) <= last_low; });
  return std::clamp(int(high - range.begin()), 1, n - 1);
}

struct PointTree::Builder {
  PointTree& tree;
  int leaf;
  std::atomic<int> used = 0;

  int build(int begin, int end) {
    const int at = used++;
    Node& node = tree.nodes_[at];
    const std::span<WeightedNormal> range(tree.points_.data() + begin, std::size_t(end - begin));
    const Sum s = sum_of(range);
    const double l = length(s.sum);
    const Vec3f centre = l > 1e-12 ? Vec3f(s.sum / l) : range[0].normal;
    node = {begin, end, -1, -1, {centre.x, centre.y, centre.z}, {s.sum.x, s.sum.y, s.sum.z}, s.weight};
    if (end - begin <= leaf) return at;
    double saved;
    const int cut = begin + cut_in_two(range, &saved);
    constexpr int kTask = 4096;
    if (end - begin > kTask)
      parallel_invoke([&] { node.left = build(begin, cut); }, [&] { node.right = build(cut, end); });
    else node.left = build(begin, cut), node.right = build(cut, end);
    return at;
  }
};

PointTree::PointTree(std::span<const WeightedNormal> points, int leaf)
    : points_(points.begin(), points.end()), nodes_(new Node[2 * points.size()]) {
  Builder{*this, leaf}.build(0, int(points_.size()));
}

}  // namespace burnish
