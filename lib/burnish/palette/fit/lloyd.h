// Lloyd iterations on the sphere: every point to its nearest centre, every centre to the centroid of its points.
//
// The error of a cell about its centroid S/‖S‖, S the weighted sum of its unit points and W their weight, is 2(W −
// ‖S‖).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "burnish/palette/fit/centre_tree.h"
#include "burnish/palette/fit/point_tree.h"

namespace burnish {

// The points of one group, its centres, and which centre each point has.
struct Cells {
  PointTree tree;
  std::vector<Vec3f> centres;
  std::vector<int> of;  // parallel to tree.points()
  std::vector<Vec3d> sum;
  std::vector<double> weight;
  std::vector<char> settled;              // whose points have not changed in the last iteration
  std::vector<Vec3f> seen;                // the centres as they were when `of` was found
  std::optional<CentreTree> centre_tree;  // over the centres; none after they have been replaced

  Cells(const std::vector<WeightedNormal>& points, int leaf) : tree(points, leaf), of(points.size()) {}

  double error_of(int k) const { return std::max(0.0, 2 * (weight[k] - length(sum[k]))); }
  double error() const {
    double e = 0;
    for (std::size_t k = 0; k < centres.size(); k++) e += error_of(int(k));
    return e;
  }
};

// The points of each cell, as positions begin[k] … begin[k + 1] of `order`.
struct Members {
  std::vector<int> begin, order;
  explicit Members(const Cells& cells);
};

// One iteration over all groups; the error of the cells about their centroids. Centres go `beyond` as far again as to
// their centroids: Lloyd steps come out too short, and longer ones converge in fewer. Deterministic, whatever the
// threads.
double lloyd(std::vector<Cells>& groups, double beyond = 0.7);

// Iterations until one gains less than that part of the error; the last error.
double lloyd_until_still(std::vector<Cells>& groups, int most_iterations, double least_gain);

}  // namespace burnish
