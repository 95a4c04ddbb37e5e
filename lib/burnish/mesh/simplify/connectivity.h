// Which triangles touch, while edges collapse: OpenMesh's halfedges, known by the numbers of vertices and triangles.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

class Connectivity {
 public:
  Connectivity();
  ~Connectivity();
  Connectivity(Connectivity&&) noexcept;

  // Both are numbered in the order in which they are added.
  std::uint32_t add_vertex();
  // False, and nothing is added, where the surface would not stay one that every edge has at most two sides of, which
  // turn the same way, and every vertex one neighbourhood.
  bool add_triangle(const Corners& vertices);

  bool has_vertex(std::uint32_t v) const;
  bool has_triangle(std::uint32_t t) const;
  bool is_border(std::uint32_t v) const;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges() const;
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
  std::vector<std::uint32_t> triangles_at(std::uint32_t v) const;
  // One or two.
  std::vector<std::uint32_t> triangles_on(std::uint32_t a, std::uint32_t b) const;

  // Whether the surface stays such a one, closed or not as it was, if `from` moves onto its neighbour `to`. A border
  // does not leave its place, and a tetrahedron stays.
  bool can_collapse(std::uint32_t from, std::uint32_t to) const;
  // The triangles on the edge are gone then.
  void collapse(std::uint32_t from, std::uint32_t to);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace burnish
