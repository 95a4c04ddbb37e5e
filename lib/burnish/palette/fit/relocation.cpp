#include "burnish/palette/fit/relocation.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

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
    CentreTree tree = *cells.centre_tree;  // as it was before the centres went to their centroids
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
      else splits[i].move.value = 0;
    }
  });
  std::ranges::stable_sort(splits, std::greater{}, [](const Split& s) { return s.move.value; });
  return splits;
}

}  // namespace

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

}  // namespace burnish
