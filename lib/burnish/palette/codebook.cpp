#include "burnish/palette/codebook.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// The points of one group, its centres, and which centre each point has.
struct Cells {
  PointTree tree;
  std::vector<Vec3f> centres;
  std::vector<int> of;  // parallel to tree.points()
  std::vector<Vec3d> sum;
  std::vector<double> weight;

  Cells(const std::vector<WeightedNormal>& points, int leaf) : tree(points, leaf), of(points.size()) {}

  double error_of(int k) const { return std::max(0.0, 2 * (weight[k] - length(sum[k]))); }
  double error() const {
    double e = 0;
    for (std::size_t k = 0; k < centres.size(); k++) e += error_of(int(k));
    return e;
  }
};

// Nearest centre of every point below a node, by filtering the centres that can be nearest (see NearestEntry).
class Assignment {
 public:
  explicit Assignment(Cells& cells) : cells_(cells) {}

  void run() {
    std::vector<int> all(cells_.centres.size());
    std::iota(all.begin(), all.end(), 0);
    descend(0, all);
  }

 private:
  void descend(int at, const std::vector<int>& candidates) {
    const PointTree::Node& node = cells_.tree.node(at);
    const Vec3f g{node.centre[0], node.centre[1], node.centre[2]};
    float best = -2;
    Vec3f nearest;
    for (int c : candidates)
      if (const float d = dot(g, cells_.centres[c]); d > best) best = d, nearest = cells_.centres[c];
    const float limit = node.radius * node.radius * 1.0001f;
    std::vector<int> kept;
    kept.reserve(32);
    for (int c : candidates) {
      const Vec3f apart = cells_.centres[c] - nearest;
      const float behind = -dot(g, apart);
      if (behind <= 1e-7f || behind * behind <= limit * dot(apart, apart)) kept.push_back(c);
    }
    if (kept.size() == 1) {
      std::fill(cells_.of.begin() + node.begin, cells_.of.begin() + node.end, kept[0]);
    } else if (node.left < 0 || node.end - node.begin <= 6) {
      for (int i = node.begin; i < node.end; i++) cells_.of[i] = nearest_of(cells_.tree.points()[i].normal, kept);
    } else if (node.end - node.begin > 2048) {
      parallel_invoke([&] { descend(node.left, kept); }, [&] { descend(node.right, kept); });
    } else {
      descend(node.left, kept);
      descend(node.right, kept);
    }
  }

  int nearest_of(Vec3f p, const std::vector<int>& candidates) const {
    int best = candidates[0];
    float most = dot(p, cells_.centres[best]);
    for (int c : candidates)
      if (const float d = dot(p, cells_.centres[c]); d > most) most = d, best = c;
    return best;
  }

  Cells& cells_;
};

void sum_up(Cells& cells) {
  cells.sum.assign(cells.centres.size(), {});
  cells.weight.assign(cells.centres.size(), 0);
  const std::vector<WeightedNormal>& points = cells.tree.points();
  for (std::size_t i = 0; i < points.size(); i++) {
    cells.sum[cells.of[i]] += Vec3d(points[i].normal) * double(points[i].weight);
    cells.weight[cells.of[i]] += points[i].weight;
  }
}

void centre_up(Cells& cells) {
  for (std::size_t k = 0; k < cells.centres.size(); k++)
    if (const double l = length(cells.sum[k]); l > 1e-12 * cells.weight[k] && l > 0) cells.centres[k] = Vec3f(cells.sum[k] / l);
}

// One Lloyd iteration; the error after it.
double lloyd(std::vector<Cells>& groups) {
  double error = 0;
  for (Cells& cells : groups) {
    Assignment(cells).run();
    sum_up(cells);
    centre_up(cells);
    error += cells.error();
  }
  return error;
}

double lloyd_until_still(std::vector<Cells>& groups, int most_iterations, double least_gain) {
  double error = lloyd(groups);
  for (int i = 1; i < most_iterations; i++) {
    const double next = lloyd(groups);
    const bool still = next >= error * (1 - least_gain);
    error = next;
    if (still) break;
  }
  return error;
}

// Part of a group in the making of the first codebook.
struct Part {
  int group, node;
  double error;
  friend bool operator<(const Part& a, const Part& b) {
    if (a.error != b.error) return a.error < b.error;
    return a.group != b.group ? a.group > b.group : a.node > b.node;
  }
};

double node_error(const PointTree::Node& n) {
  return std::max(0.0, 2 * (n.weight - std::sqrt(n.sum[0] * n.sum[0] + n.sum[1] * n.sum[1] + n.sum[2] * n.sum[2])));
}

// Greedy: always divides the part of largest error, of whichever group.
void split_until(std::vector<Cells>& groups, int n) {
  std::priority_queue<Part> parts;
  std::vector<Part> done;
  for (std::size_t g = 0; g < groups.size(); g++) parts.push({int(g), 0, node_error(groups[g].tree.node(0))});
  while (!parts.empty() && int(parts.size() + done.size()) < n) {
    const Part part = parts.top();
    parts.pop();
    const PointTree& tree = groups[part.group].tree;
    const PointTree::Node& node = tree.node(part.node);
    if (node.left < 0) {
      done.push_back(part);
      continue;
    }
    for (int child : {node.left, node.right}) parts.push({part.group, child, node_error(tree.node(child))});
  }
  for (; !parts.empty(); parts.pop()) done.push_back(parts.top());
  std::ranges::sort(done, [&](const Part& a, const Part& b) {
    return a.group != b.group ? a.group < b.group
                              : groups[a.group].tree.node(a.node).begin < groups[b.group].tree.node(b.node).begin;
  });
  for (const Part& part : done) {
    const PointTree::Node& node = groups[part.group].tree.node(part.node);
    groups[part.group].centres.push_back({node.centre[0], node.centre[1], node.centre[2]});
  }
}

// The centre nearest to another one, by the tree over the centres (leaves of which are single).
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Vec3f>& centres) : tree_(weighted(centres), 4) {}

  // Squared chord from `v` to the nearest centre that is not within 1e-7 of it … and that centre.
  float nearest_other(Vec3f v, Vec3f* found) const {
    float best = 8;
    search(0, v, best, found);
    return best;
  }

 private:
  static std::vector<WeightedNormal> weighted(const std::vector<Vec3f>& centres) {
    std::vector<WeightedNormal> out;
    for (const Vec3f& c : centres) out.push_back({c, 1.f});
    return out;
  }
  void search(int at, Vec3f v, float& best, Vec3f* found) const {
    const PointTree::Node& node = tree_.node(at);
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; i++) {
        const Vec3f d = tree_.points()[i].normal - v;
        if (const float q = dot(d, d); q < best && q > 0) best = q, *found = tree_.points()[i].normal;
      }
      return;
    }
    const auto reach = [&](int child) {
      const PointTree::Node& c = tree_.node(child);
      return std::max(0.f, length(Vec3f{c.centre[0], c.centre[1], c.centre[2]} - v) - c.radius);
    };
    const float l = reach(node.left), r = reach(node.right);
    for (const auto& [child, distance] : l <= r ? std::array{std::pair{node.left, l}, std::pair{node.right, r}}
                                               : std::array{std::pair{node.right, r}, std::pair{node.left, l}})
      if (distance * distance < best) search(child, v, best, found);
  }
  PointTree tree_;
};

struct Move {
  int group, centre;
  double value;
};

// What it costs to do without each centre (its points go to its nearest neighbour), least first.
std::vector<Move> removal_costs(const std::vector<Cells>& groups) {
  std::vector<Move> all;
  for (std::size_t g = 0; g < groups.size(); g++) {
    const Cells& cells = groups[g];
    if (cells.centres.size() < 2) continue;
    const Neighbours neighbours(cells.centres);
    std::vector<double> cost(cells.centres.size());
    parallel_for_chunks(cost.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; k++) {
        Vec3f other;
        // Moving the cell to the other centre: |S_k| − S_k·c', twice, is the change of Σ w|p − c|².
        if (cells.weight[k] > 0 && neighbours.nearest_other(cells.centres[k], &other) < 8)
          cost[k] = std::max(0.0, 2 * (length(cells.sum[k]) - dot(cells.sum[k], Vec3d(other))));
      }
    });
    for (std::size_t k = 0; k < cost.size(); k++) all.push_back({int(g), int(k), cost[k]});
  }
  std::ranges::stable_sort(all, {}, &Move::value);
  return all;
}

struct Split {
  Move move;
  Vec3f low, high;
};

// What it saves to give each cell a second centre, most first.
std::vector<Split> split_gains(const std::vector<Cells>& groups, std::size_t most) {
  std::vector<Move> errors;
  for (std::size_t g = 0; g < groups.size(); g++)
    for (std::size_t k = 0; k < groups[g].centres.size(); k++)
      if (const double e = groups[g].error_of(int(k)); e > 0) errors.push_back({int(g), int(k), e});
  std::ranges::stable_sort(errors, std::greater{}, &Move::value);
  errors.resize(std::min(errors.size(), most));

  std::vector<std::vector<std::vector<WeightedNormal>>> members(groups.size());
  std::vector<std::vector<int>> slot(groups.size());
  for (std::size_t g = 0; g < groups.size(); g++) slot[g].assign(groups[g].centres.size(), -1);
  std::vector<std::vector<WeightedNormal>> points(errors.size());
  for (std::size_t i = 0; i < errors.size(); i++) slot[errors[i].group][errors[i].centre] = int(i);
  for (std::size_t g = 0; g < groups.size(); g++)
    for (std::size_t i = 0; i < groups[g].of.size(); i++)
      if (const int s = slot[g][groups[g].of[i]]; s >= 0) points[s].push_back(groups[g].tree.points()[i]);

  std::vector<Split> splits(errors.size());
  parallel_for_chunks(errors.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) {
      splits[i].move = {errors[i].group, errors[i].centre, 0};
      if (points[i].size() < 2) continue;
      const std::size_t cut = std::size_t(cut_in_two(points[i], &splits[i].move.value));
      Vec3d low, high;
      for (std::size_t p = 0; p < points[i].size(); p++)
        (p < cut ? low : high) += Vec3d(points[i][p].normal) * double(points[i][p].weight);
      if (length(low) > 0 && length(high) > 0)
        splits[i].low = Vec3f(normalized(low)), splits[i].high = Vec3f(normalized(high));
      else
        splits[i].move.value = 0;
    }
  });
  std::ranges::stable_sort(splits, std::greater{}, [](const Split& s) { return s.move.value; });
  return splits;
}

// Moves the centres that are missed least into the cells that gain most, while `eager`·gain exceeds the cost. How many moved.
int relocate(std::vector<Cells>& groups, double eager, int most) {
  const std::vector<Move> costs = removal_costs(groups);
  const std::vector<Split> gains = split_gains(groups, std::size_t(most) * 2);
  std::vector<std::vector<char>> touched(groups.size());
  for (std::size_t g = 0; g < groups.size(); g++) touched[g].assign(groups[g].centres.size(), 0);
  std::vector<int> live(groups.size());
  for (std::size_t g = 0; g < groups.size(); g++) live[g] = int(groups[g].centres.size());

  std::vector<std::pair<Move, Split>> moves;
  std::size_t c = 0;
  for (const Split& split : gains) {
    if (int(moves.size()) >= most) break;
    while (c < costs.size() && (touched[costs[c].group][costs[c].centre] || live[costs[c].group] < 2)) c++;
    if (c == costs.size() || !(eager * split.move.value > costs[c].value)) break;
    char& gaining = touched[split.move.group][split.move.centre];
    if (gaining || (split.move.group == costs[c].group && split.move.centre == costs[c].centre)) continue;
    gaining = 1;
    touched[costs[c].group][costs[c].centre] = 1;
    live[costs[c].group]--;
    live[split.move.group]++;
    moves.emplace_back(costs[c], split);
  }
  std::vector<std::vector<char>> removed(groups.size());
  for (std::size_t g = 0; g < groups.size(); g++) removed[g].assign(groups[g].centres.size(), 0);
  for (const auto& [from, to] : moves) {
    Cells& target = groups[to.move.group];
    target.centres[to.move.centre] = to.low;
    removed[from.group][from.centre] = 1;
    target.centres.push_back(to.high);
  }
  for (std::size_t g = 0; g < groups.size(); g++) {
    std::vector<Vec3f>& centres = groups[g].centres;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < centres.size(); k++)
      if (k >= removed[g].size() || !removed[g][k]) centres[kept++] = centres[k];
    centres.resize(kept);
  }
  return int(moves.size());
}

std::vector<std::vector<Vec3f>> centres_of(const std::vector<Cells>& groups) {
  std::vector<std::vector<Vec3f>> out;
  for (const Cells& cells : groups) out.push_back(cells.centres);
  return out;
}

}  // namespace

int Codebook::size() const {
  int n = 0;
  for (const auto& g : groups) n += int(g.size());
  return n;
}

namespace {

std::size_t count_points(std::span<const std::vector<WeightedNormal>> groups, int n) {
  if (int(groups.size()) > n)
    throw Error(ErrorKind::kMalformed, "expected at least as many normals as materials, got " + std::to_string(n) +
                                           " normals for " + std::to_string(groups.size()) + " materials");
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
  for (const Cells& cells : split_into_cells(points, n, count_points(points, n))) share.push_back(int(cells.centres.size()));
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

  best.error = lloyd_until_still(groups, 12, 2e-3);
  best.groups = centres_of(groups);
  double eager = 4;
  constexpr int kRounds = 16;
  for (int round = 0; round < kRounds && eager > 0.5; round++) {
    report_progress(progress, 0.3 + 0.7 * round / kRounds);
    if (relocate(groups, eager, std::max(1, n / 8)) == 0) {
      eager = 0;
      break;
    }
    const double error = lloyd_until_still(groups, 4, 1e-3);
    if (error < best.error) {
      const bool little = error > best.error * (1 - 1e-3);
      best.error = error;
      best.groups = centres_of(groups);
      if (little) eager *= 0.7;
    } else {
      eager *= 0.5;
      for (std::size_t g = 0; g < groups.size(); g++) groups[g].centres = best.groups[g];
      lloyd(groups);
    }
  }
  for (std::size_t g = 0; g < groups.size(); g++) groups[g].centres = best.groups[g];
  best.error = lloyd_until_still(groups, 12, 2e-4);
  best.groups = centres_of(groups);
  return best;
}

}  // namespace burnish
