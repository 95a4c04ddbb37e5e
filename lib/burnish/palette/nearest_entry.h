// The palette entry nearest to a direction, exactly, in time that hardly grows with the palette.
//
// The faces of a cube are cut into quadtrees. A cell keeps the entries that can be nearest to some direction inside it:
// with z* the entry nearest to the cell's centre g and ρ the radius of a ball round the cell, entry z is out where it
// is farther than z* on the whole ball, g·(z − z*) + ρ‖z − z*‖ < 0 (the filter of Kanungo et al., "An efficient k-means
// clustering algorithm", PAMI 2002). A cell is divided while it keeps more than a handful. A query walks to its leaf
// and compares dot products.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

class NearestEntry {
 public:
  // `entries` are unit; 1 to 65536 of them; they are copied. Builds in parallel; the result does not depend on threads.
  explicit NearestEntry(std::span<const Vec3f> entries);

  // Index of the entry that is v; where there is none, of that with the largest dot product with v, which in floats
  // ties entries less than 0.02° apart. The smaller index in a tie. v has any length but 0.
  int operator()(Vec3f v) const;

 private:
  struct Node {
    std::uint32_t first;  // inner: of its four children in nodes_; leaf: of its entries in candidates_
    std::uint32_t count;  // 0: inner
  };
  struct FaceTree {
    std::vector<Node> nodes;
    std::vector<std::uint16_t> candidates;
    std::vector<std::uint32_t> top;  // node of each cell of the grid where a walk begins
  };
  void build(FaceTree& tree, int face, std::uint32_t node, const std::vector<std::uint16_t>& candidates, int depth,
             std::uint32_t column, std::uint32_t row) const;

  std::vector<Vec3f> entries_;
  FaceTree faces_[6];
};

}  // namespace burnish
