#include "burnish/palette/fit/lloyd.h"

#include <cmath>
#include <numeric>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// Gives every point its nearest centre, exactly. A centre nearer than c to a point at distance d of c is within 2d of c
// (the triangle inequality), so a cell's points need to see only the centres within twice its radius; where neither its
// own centre nor any of those has moved since the last time, nothing can have changed.
void assign(Cells& cells) {
  const std::vector<WeightedNormal>& points = cells.tree.points();
  const std::vector<Vec3f>& centres = cells.centres;
  if (cells.centre_tree) cells.centre_tree->refit(centres);
  else cells.centre_tree.emplace(centres);
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

// Not beyond the centroid where the step is long for the cell, nor where the cell has settled.
void centre_up(Cells& cells, double beyond) {
  for (std::size_t k = 0; k < cells.centres.size(); k++) {
    const double l = length(cells.sum[k]);
    if (!(l > 1e-12 * cells.weight[k])) continue;
    Vec3d centroid = cells.sum[k] / l;
    const Vec3d step = centroid - Vec3d(cells.centres[k]);
    const double mean_error2 = std::max(0.0, 2 * (1 - l / cells.weight[k]));
    if (beyond > 0 && !cells.settled[k] && dot(step, step) < 0.25 * mean_error2)
      centroid = normalized(centroid + step * beyond);
    cells.centres[k] = Vec3f(centroid);
  }
}

}  // namespace

Members::Members(const Cells& cells) : begin(cells.centres.size() + 1), order(cells.of.size()) {
  for (int k : cells.of) begin[k + 1]++;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> next = begin;
  for (std::size_t i = 0; i < cells.of.size(); i++) order[next[cells.of[i]]++] = int(i);
}

double lloyd(std::vector<Cells>& groups, double beyond) {
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

}  // namespace burnish
