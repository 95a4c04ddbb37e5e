// Which triangle covers which texel of a map over a mesh's texture coordinates, and where on it the texel lies.
//
// Texel (x, y) of a W×H map has its centre at u = (x + ½)/W, v = 1 − (y + ½)/H. Corners are rounded to 1/4096 texel and
// the rest is integer arithmetic, so that of two triangles on either side of an edge exactly one takes a centre that
// lies on it: the one that covers what is right of the centre, or below where the edge runs across. A map of n·W × n·H
// texels holds n×n sub-samples of each texel of a W×H one. Triangles without area in the map cover nothing. Memory
// holds about 60 bytes a triangle, and four for every 32 rows that it reaches over.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

class UvRaster {
 public:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr int kMostTexels = 1 << 18;  // a side

  // All texture coordinates lie in [0,1] (see require_atlas). kUsage for sizes outside [1, kMostTexels].
  UvRaster(const Mesh& mesh, int width, int height);

  // Of each texel of a row the triangle that covers it, or kNone; of several the smallest, and `several` is 1 there,
  // else 0. May be called from many threads.
  void row(int y, std::uint32_t* triangles, std::uint8_t* several) const;

  // The point of the triangle at the centre of a texel that it covers; no weight is negative.
  MeshPoint point(std::uint32_t triangle, int x, int y) const;

 private:
  struct Place {
    std::int64_t x = 0, y = 0;  // right and down, in 1/4096 texel
  };
  // Twice the area of a, b and the centre of texel (0, y), and by how much a step to the right lessens it.
  struct Edge {
    std::int64_t value, step;
    bool takes_ties;
  };
  struct Rows {
    int first = 0, end = 0;
  };
  template <typename Body>
  static void for_each_band(Rows rows, const Body& body);
  static std::int64_t twice_area(Place a, Place b, Place c);
  static Edge edge(Place a, Place b, int y);

  int width_;
  std::vector<std::array<Place, 3>> places_;   // of each triangle's corners
  std::vector<Rows> rows_;                     // of each triangle
  std::vector<std::size_t> band_begin_;        // where the triangles of each band of rows begin
  std::vector<std::uint32_t> band_triangles_;  // ascending within a band
};

// The chart of each triangle. Triangles belong to one chart where they share an edge, in space and in the map; charts
// are numbered in the order of their first triangles.
std::vector<std::uint32_t> uv_charts(const Mesh& mesh);

}  // namespace burnish
