#include "burnish/palette/nearest_entry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

constexpr int kTopDepth = 4;         // walks begin on a grid of 16 × 16 cells a face
constexpr int kMaxDepth = 14;        // where entries coincide no division parts them
constexpr float kFarthest = 16;      // radii from the nearest entry to a cell that is divided
constexpr std::size_t kLeaf = 6;     // comparing so few is as fast as going deeper
constexpr float kAlike = 1 - 1e-6f;  // of unit vectors above it rounding may tie others with the vector itself

struct FacePoint {
  int face;
  float u, v;  // in [−1, 1]
};

FacePoint project(Vec3f d) {
  const float ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (az >= ax && az >= ay) return {d.z >= 0 ? 4 : 5, d.x / az, d.y / az};
  if (ax >= ay) return {d.x >= 0 ? 0 : 1, d.y / ax, d.z / ax};
  return {d.y >= 0 ? 2 : 3, d.x / ay, d.z / ay};
}

Vec3f unproject(int face, float u, float v) {
  const float s = face % 2 ? -1.f : 1.f;
  if (face < 2) return {s, u, v};
  if (face < 4) return {u, s, v};
  return {u, v, s};
}

std::uint32_t cell(float t) {
  return std::uint32_t(std::clamp((t + 1.f) * float(1 << (kMaxDepth - 1)), 0.f, float((1 << kMaxDepth) - 1)));
}

}  // namespace

NearestEntry::NearestEntry(std::span<const Vec3f> entries) : entries_(entries.begin(), entries.end()) {
  std::vector<std::uint16_t> all(entries_.size());
  std::iota(all.begin(), all.end(), std::uint16_t(0));
  // Of equal entries only the first can win, and no division would part them.
  const auto place = [&](std::uint16_t i) { return std::tuple(entries_[i].x, entries_[i].y, entries_[i].z); };
  std::ranges::stable_sort(all, {}, place);
  all.erase(std::unique(all.begin(), all.end(), [&](std::uint16_t a, std::uint16_t b) { return place(a) == place(b); }),
            all.end());
  std::ranges::sort(all);
  parallel_for(6, [&](std::size_t face) {
    FaceTree& tree = faces_[face];
    tree.nodes.push_back({});
    tree.top.resize(std::size_t(1) << (2 * kTopDepth));
    build(tree, int(face), 0, all, 0, 0, 0);
  });
}

void NearestEntry::build(FaceTree& tree, int face, std::uint32_t node, const std::vector<std::uint16_t>& candidates,
                         int depth, std::uint32_t column, std::uint32_t row) const {
  const float side = 2.f / float(1u << depth);
  const Vec3f corner = unproject(face, -1.f + (float(column) + 0.5f) * side, -1.f + (float(row) + 0.5f) * side);
  const float distance = length(corner);
  const Vec3f g = corner * (1.f / distance);
  // Half the diagonal on the face, which lies at least this far out; a little more for rounding.
  const float half_diagonal = side * 0.70710678f;
  const float radius = half_diagonal / std::max(1.f, distance - half_diagonal) * 1.0001f + 1e-6f;

  std::vector<std::uint16_t> kept;
  float best = -2;
  Vec3f nearest;
  for (std::uint16_t c : candidates)
    if (const float d = dot(g, entries_[c]); d > best) best = d, nearest = entries_[c];
  std::size_t within_reach = 0;  // the others are kept because rounding may tie them, which no division changes
  for (std::uint16_t c : candidates) {
    const Vec3f apart = entries_[c] - nearest;
    const float behind = -dot(g, apart);  // ≥ 0
    const bool reach = behind * behind <= radius * radius * dot(apart, apart) * 1.0001f;
    within_reach += reach;
    if (reach || behind <= 1e-6f) kept.push_back(c);
  }

  // Far from every entry nobody asks, and there a cell may keep many however small it is: all of them round the pole of
  // a circle.
  const bool near = radius * kFarthest > std::sqrt(std::max(0.f, 2 - 2 * best));
  const bool divide = depth < kTopDepth || (within_reach > kLeaf && depth < kMaxDepth && near);
  if (depth == kTopDepth) tree.top[(row << kTopDepth) | column] = node;
  if (!divide) {
    tree.nodes[node] = {std::uint32_t(tree.candidates.size()), std::uint32_t(kept.size())};
    tree.candidates.insert(tree.candidates.end(), kept.begin(), kept.end());
    return;
  }
  const std::uint32_t first = std::uint32_t(tree.nodes.size());
  tree.nodes[node] = {first, 0};
  tree.nodes.resize(first + 4);
  for (std::uint32_t child = 0; child < 4; child++)
    build(tree, face, first + child, kept, depth + 1, 2 * column + (child & 1), 2 * row + (child >> 1));
}

int NearestEntry::operator()(Vec3f v) const {
  const FacePoint p = project(v);
  const FaceTree& tree = faces_[p.face];
  const std::uint32_t column = cell(p.u), row = cell(p.v);
  int shift = kMaxDepth - kTopDepth;
  Node node = tree.nodes[tree.top[((row >> shift) << kTopDepth) | (column >> shift)]];
  while (node.count == 0) {
    shift--;
    node = tree.nodes[node.first + ((column >> shift) & 1) + 2 * ((row >> shift) & 1)];
  }
  int best = tree.candidates[node.first];
  float most = dot(v, entries_[best]);
  for (std::uint32_t i = 1; i < node.count; i++) {
    const int c = tree.candidates[node.first + i];
    if (const float d = dot(v, entries_[c]); d > most) most = d, best = c;
  }
  if (most > kAlike && entries_[best] != v)
    for (std::uint32_t i = 0; i < node.count; i++)
      if (const int c = tree.candidates[node.first + i]; entries_[c] == v) return c;
  return best;
}

}  // namespace burnish
