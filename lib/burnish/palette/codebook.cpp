#include "burnish/palette/codebook.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "burnish/core/error.h"
#include "burnish/palette/fit/lloyd.h"
#include "burnish/palette/fit/relocation.h"

namespace burnish {
namespace {

// Part of a group in the making of the first codebook.
struct Part {
  int group, node, begin;  // where its points begin decides ties: how nodes are numbered depends on the threads
  double error;
  friend bool operator<(const Part& a, const Part& b) {
    if (a.error != b.error) return a.error < b.error;
    return a.group != b.group ? a.group > b.group : a.begin > b.begin;
  }
};

double node_error(const PointTree::Node& n) {
  return std::max(0.0, 2 * (n.weight - std::sqrt(n.sum[0] * n.sum[0] + n.sum[1] * n.sum[1] + n.sum[2] * n.sum[2])));
}

// Greedy: always divides the part of largest error, of whichever group.
void split_until(std::vector<Cells>& groups, int n) {
  std::priority_queue<Part> parts;
  std::vector<Part> done;
  const auto add = [&](int group, int at) {
    const PointTree::Node& node = groups[group].tree.node(at);
    parts.push({group, at, node.begin, node_error(node)});
  };
  for (std::size_t g = 0; g < groups.size(); g++) add(int(g), 0);
  while (!parts.empty() && int(parts.size() + done.size()) < n) {
    const Part part = parts.top();
    parts.pop();
    const PointTree::Node& node = groups[part.group].tree.node(part.node);
    if (node.left < 0) {
      done.push_back(part);
      continue;
    }
    for (int child : {node.left, node.right}) add(part.group, child);
  }
  for (; !parts.empty(); parts.pop()) done.push_back(parts.top());
  std::ranges::sort(done, {}, [](const Part& p) { return std::pair(p.group, p.begin); });
  for (const Part& part : done) {
    const PointTree::Node& node = groups[part.group].tree.node(part.node);
    groups[part.group].centres.push_back({node.centre[0], node.centre[1], node.centre[2]});
  }
}

// What a round of relocations starts from and goes back to.
struct State {
  std::vector<Vec3f> centres, seen;
  std::vector<int> of;
  std::vector<Vec3d> sum;
  std::vector<double> weight;
};

std::vector<State> save(const std::vector<Cells>& groups) {
  std::vector<State> out;
  for (const Cells& c : groups) out.push_back({c.centres, c.seen, c.of, c.sum, c.weight});
  return out;
}

void restore(std::vector<Cells>& groups, const std::vector<State>& saved) {
  for (std::size_t g = 0; g < groups.size(); g++) {
    Cells& c = groups[g];
    const State& s = saved[g];
    c.centres = s.centres, c.seen = s.seen, c.of = s.of, c.sum = s.sum, c.weight = s.weight;
    c.centre_tree.emplace(c.centres);
  }
}

}  // namespace

int Codebook::size() const {
  int n = 0;
  for (const auto& g : groups) n += int(g.size());
  return n;
}

void require_an_entry_each(std::size_t groups, int n) {
  if (groups > std::size_t(n))
    throw Error(ErrorKind::kMalformed, "normals: expected at least one for each of " + std::to_string(groups) +
                                           " materials, got " + std::to_string(n));
}

namespace {

std::size_t count_points(std::span<const std::vector<WeightedNormal>> groups, int n) {
  require_an_entry_each(groups.size(), n);
  std::size_t total = 0;
  for (const auto& g : groups) total += g.size();
  return total;
}

std::vector<Cells> split_into_cells(std::span<const std::vector<WeightedNormal>> points, int n, std::size_t total) {
  const int leaf = total > 32 * std::size_t(n) ? 8 : 1;  // few points a cell need a tree down to the points
  std::vector<Cells> groups;
  groups.reserve(points.size());
  for (const auto& g : points) groups.emplace_back(g, leaf);
  split_until(groups, n);
  return groups;
}

}  // namespace

std::vector<int> share_entries(std::span<const std::vector<WeightedNormal>> points, int n) {
  std::vector<int> share;
  for (const Cells& cells : split_into_cells(points, n, count_points(points, n)))
    share.push_back(int(cells.centres.size()));
  return share;
}

Codebook fit_codebook(std::span<const std::vector<WeightedNormal>> points, int n, const Progress& progress) {
  const std::size_t total = count_points(points, n);
  Codebook best;
  if (total <= std::size_t(n)) {
    for (const auto& g : points) {
      best.groups.emplace_back();
      for (const WeightedNormal& p : g) best.groups.back().push_back(p.normal);
    }
    return best;
  }

  std::vector<Cells> groups = split_into_cells(points, n, total);
  report_progress(progress, 0.2);

  best.error = lloyd_until_still(groups, 8, 2e-3);
  // A move is tried where its gain, before Lloyd iterations have made the most of it, times `eager` exceeds its cost.
  double eager = 4;
  constexpr int kRounds = 14;
  constexpr double kLeastEager = 0.4, kLittle = 2e-3;
  for (int round = 0; round < kRounds && eager > kLeastEager; round++) {
    report_progress(progress, 0.3 + 0.7 * round / kRounds);
    const std::vector<State> before = save(groups);
    if (relocate(groups, eager, std::max(1, n / 8)) == 0) break;
    const double error = lloyd_until_still(groups, 4, 1e-3);
    if (error > best.error * (1 - kLittle)) eager *= 0.6;
    if (error < best.error) best.error = error;
    else restore(groups, before);
  }
  lloyd_until_still(groups, 60, 5e-5);
  best.error = lloyd(groups, 0);
  for (const Cells& cells : groups) best.groups.push_back(cells.centres);
  return best;
}

}  // namespace burnish
