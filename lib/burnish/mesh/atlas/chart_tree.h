// Triangles of a mesh grouped into ever larger pieces that are nearly flat and compact.
//
// Of two pieces that share a border those become one whose union is the flattest and roundest, again and again
// (hierarchical face clustering; Garland, Willmott and Heckbert, 2001), as long as the union faces one way: its area
// seen along its mean normal is at least 85 % of its own. A sphere's cap of 45° is such a piece.
#pragma once

#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

class ChartTree {
 public:
  // Positions that coincide count as one. Only edges of two triangles that turn the same way join pieces.
  explicit ChartTree(const Mesh& mesh);

  struct Piece {
    std::uint32_t one, two;  // of a single triangle none
  };
  static constexpr std::uint32_t kNone = ~0u;
  const std::vector<std::uint32_t>& roots() const { return roots_; }  // that no piece contains
  Piece parts(std::uint32_t piece) const { return pieces_[piece]; }
  bool is_triangle(std::uint32_t piece) const { return pieces_[piece].one == kNone; }
  std::vector<std::uint32_t> triangles(std::uint32_t piece) const;

 private:
  std::vector<Piece> pieces_;  // the triangles first
  std::vector<std::uint32_t> roots_;
};

}  // namespace burnish
