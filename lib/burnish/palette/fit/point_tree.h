// A tree over weighted points on the sphere: ranges of nearby points with their sum.
//
// The codebook engine takes its first cells from the nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "burnish/core/vec3.h"
#include "burnish/palette/fit/weighted_normal.h"

namespace burnish {

class PointTree {
 public:
  struct Node {
    int begin, end;   // of points()
    int left, right;  // −1 in a leaf
    float centre[3];  // unit
    double sum[3];    // Σ weight·normal
    double weight;    // Σ weight
  };

  // Divides at the cut along the axis of largest variance that leaves the least variance, down to `leaf` points.
  PointTree(std::span<const WeightedNormal> points, int leaf);

  const std::vector<WeightedNormal>& points() const { return points_; }  // in the tree's order
  const Node& node(int i) const { return nodes_[i]; }                    // 0 is the root

 private:
  struct Builder;
  std::vector<WeightedNormal> points_;
  std::unique_ptr<Node[]> nodes_;
};

// Where to cut a range of points in two: reorders them so that [begin, cut) and [cut, end) are the parts; the error
// saved by two centroids instead of one is added in `saved` (squared chord). A range of equal points is cut anywhere
// and saves 0.
int cut_in_two(std::span<WeightedNormal> range, double* saved);

}  // namespace burnish
