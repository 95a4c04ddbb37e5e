#include "burnish/palette/codebook.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/centre_tree.h"

namespace burnish {
namespace {

// The points of one group, its centres, and which centre each point has.
struct Cells {
  PointTree tree;
  std::vector<Vec3f> centres;
  std::vector<int> of;  // parallel to tree.points()
  std::vector<Vec3d> sum;
  std::vector<double> weight;
  std::vector<char> settled;  // whose points have not changed in the last iteration
  std::vector<Vec3f> seen;  // the centres as they were when `of` was found
  std::optional<CentreTree> centre_tree;  // over the centres; none after they have been replaced

  Cells(const std::vector<WeightedNormal>& points, int leaf) : tree(points, leaf), of(points.size()) {}

  double error_of(int k) const { return std::max(0.0, 2 * (weight[k] - length(sum[k]))); }
  double error() const {
    double e = 0;
    for (std::size_t k = 0; k < centres.size(); k++) e += error_of(int(k));
    return e;
  }
};

std::vector<int> all_of(std::size_t n) {
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// The points of each cell, as positions begin[k] … begin[k + 1] of `order`.
struct Members {
  std::vector<int> begin, order;

  explicit Members(const Cells& cells) : begin(cells.centres.size() + 1), order(cells.of.size()) {
    for (int k : cells.of) begin[k + 1]++;
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<int> next = begin;
    for (std::size_t i = 0; i < cells.of.size(); i++) order[next[cells.of[i]]++] = int(i);
  }
};

// Gives every point its nearest centre, exactly. A centre nearer than c to a point at distance d of c is within 2d of c (the
// triangle inequality), so a cell's points need to see only the centres within twice its radius; where neither its own centre nor
// any of those has moved since the last time, nothing can have changed.
void assign(Cells& cells) {
  const std::vector<WeightedNormal>& points = cells.tree.points();
  const std::vector<Vec3f>& centres = cells.centres;
  if (cells.centre_tree)
    cells.centre_tree->refit(centres);
  else
    cells.centre_tree.emplace(centres, all_of(centres.size()));
  const CentreTree& all = *cells.centre_tree;
  const auto from_scratch = [&](int i) {
    float best2 = 8;
    return all.nearest(points[i].normal, best2);
  };
  if (cells.seen.size() != centres.size()) {
    parallel_for_chunks(points.size(), 2048, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; i++) cells.of[i] = from_scratch(int(i));
    });
    cells.seen = centres;
    return;
  }
  std::vector<int> moved;
  for (std::size_t k = 0; k < centres.size(); k++)
    if (!(centres[k] == cells.seen[k])) moved.push_back(int(k));
  const CentreTree moved_tree(centres, std::move(moved));
  const Members members(cells);
  parallel_for_chunks(centres.size(), 64, [&](std::size_t first, std::size_t last, std::size_t) {
    std::vector<std::pair<float, int>> near;  // squared distance from the cell's centre, centre
    for (std::size_t k = first; k < last; k++) {
      const int begin = members.begin[k], end = members.begin[k + 1];
      const Vec3f centre = centres[k];
      float radius2 = 0;
      for (int m = begin; m < end; m++) {
        const Vec3f d = points[members.order[m]].normal - centre;
        radius2 = std::max(radius2, dot(d, d));
      }
      const Vec3f step = centre - cells.seen[k];
      const float step2 = dot(step, step), reach2 = 4.0001f * radius2 + 1e-12f;
      if (step2 == 0 && moved_tree.for_each_within(centre, reach2, [](int, float) { return false; })) continue;
      if (step2 > 0.25f * radius2) {  // it has left its points behind: what surrounds it tells nothing about them
        for (int m = begin; m < end; m++) cells.of[members.order[m]] = from_scratch(members.order[m]);
        continue;
      }
      near.clear();
      all.for_each_within(centre, reach2, [&](int other, float d2) {
        if (other != int(k)) near.emplace_back(d2, other);
        return true;
      });
      std::ranges::sort(near);
      for (int m = begin; m < end; m++) {
        const Vec3f p = points[members.order[m]].normal;
        const Vec3f d = p - centre;
        float best2 = dot(d, d);
        const float enough = 4.0001f * best2 + 1e-12f;
        int best = int(k);
        for (const auto& [d2, other] : near) {
          if (d2 > enough) break;
          const Vec3f e = p - centres[other];
          if (const float e2 = dot(e, e); e2 < best2) best2 = e2, best = other;
        }
        cells.of[members.order[m]] = best;
      }
    }
  });
  cells.seen = centres;
}

// Sums of the cells; marks those that are as they were in `settled`.
void sum_up(Cells& cells) {
  std::vector<Vec3d> before(cells.centres.size());
  before.swap(cells.sum);
  before.resize(cells.centres.size());
  cells.weight.assign(cells.centres.size(), 0);
  const std::vector<WeightedNormal>& points = cells.tree.points();
  for (std::size_t i = 0; i < points.size(); i++) {
    cells.sum[cells.of[i]] += Vec3d(points[i].normal) * double(points[i].weight);
    cells.weight[cells.of[i]] += points[i].weight;
  }
  cells.settled.resize(cells.centres.size());
  for (std::size_t k = 0; k < before.size(); k++) cells.settled[k] = before[k] == cells.sum[k];
}

// Moves the centres to their centroids, or `beyond` as far again: Lloyd steps come out too short, and longer ones converge in
// fewer. Not where the step is long for the cell, nor where the cell has settled.
void centre_up(Cells& cells, double beyond) {
  for (std::size_t k = 0; k < cells.centres.size(); k++) {
    const double l = length(cells.sum[k]);
    if (!(l > 1e-12 * cells.weight[k])) continue;
    Vec3d centroid = cells.sum[k] / l;
    const Vec3d step = centroid - Vec3d(cells.centres[k]);
    const double mean_error2 = std::max(0.0, 2 * (1 - l / cells.weight[k]));
    if (beyond > 0 && !cells.settled[k] && dot(step, step) < 0.25 * mean_error2) centroid = normalized(centroid + step * beyond);
    cells.centres[k] = Vec3f(centroid);
  }
}

// One Lloyd iteration; the error of its cells about their centroids.
double lloyd(std::vector<Cells>& groups, double beyond = 0.7) {
  double error = 0;
  for (Cells& cells : groups) {
    assign(cells);
    sum_up(cells);
    centre_up(cells, beyond);
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
    CentreTree tree = *cells.centre_tree;
    tree.refit(cells.centres);
    std::vector<double> cost(cells.centres.size());
    parallel_for_chunks(cost.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; k++) {
        if (cells.weight[k] == 0) continue;
        float best2 = 8;
        const Vec3f other = cells.centres[tree.nearest(cells.centres[k], best2, int(k))];
        // Moving the cell to the other centre changes Σ w|p − c|² by twice |S_k| − S_k·c'.
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

  std::vector<Members> members;
  members.reserve(groups.size());
  for (const Cells& cells : groups) members.emplace_back(cells);

  std::vector<Split> splits(errors.size());
  parallel_for_chunks(errors.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<WeightedNormal> points;
    for (std::size_t i = begin; i < end; i++) {
      splits[i].move = {errors[i].group, errors[i].centre, 0};
      const Members& m = members[errors[i].group];
      points.clear();
      for (int p = m.begin[errors[i].centre]; p < m.begin[errors[i].centre + 1]; p++)
        points.push_back(groups[errors[i].group].tree.points()[m.order[p]]);
      if (points.size() < 2) continue;
      const std::size_t cut = std::size_t(cut_in_two(points, &splits[i].move.value));
      Vec3d low, high;
      for (std::size_t p = 0; p < points.size(); p++)
        (p < cut ? low : high) += Vec3d(points[p].normal) * double(points[p].weight);
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
  std::vector<std::vector<int>> removed(groups.size());
  for (const auto& [from, to] : moves) {
    Cells& target = groups[to.move.group];
    target.centres[to.move.centre] = to.low;
    if (from.group == to.move.group) {
      target.centres[from.centre] = to.high;  // in its place, so that the others keep theirs
    } else {
      target.centres.push_back(to.high);
      removed[from.group].push_back(from.centre);
    }
  }
  for (std::size_t g = 0; g < groups.size(); g++) {
    std::ranges::sort(removed[g], std::greater{});
    for (int k : removed[g]) groups[g].centres.erase(groups[g].centres.begin() + k);
    groups[g].centre_tree.reset();
  }
  return int(moves.size());
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
    c.centre_tree.emplace(c.centres, all_of(c.centres.size()));
  }
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
    if (error < best.error)
      best.error = error;
    else
      restore(groups, before);
  }
  lloyd_until_still(groups, 60, 5e-5);
  best.error = lloyd(groups, 0);
  for (const Cells& cells : groups) best.groups.push_back(cells.centres);
  return best;
}

}  // namespace burnish
