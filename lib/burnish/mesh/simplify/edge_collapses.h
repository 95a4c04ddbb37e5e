// Which way an edge of a surface collapses best, what that costs, and whether it may: decimate.h says by which measure.
// Internal to decimation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/mesh/simplify/wedged_surface.h"

namespace burnish {

// N is 3, or 5 with texture coordinates.
template <int N>
class EdgeCollapses {
 public:
  struct Collapse {
    std::uint32_t from, to;
    std::vector<typename WedgedSurface<N>::Merge> merges;
    double cost;
    std::optional<PointN<N>> moved_to{};  // of the vertex that stays
  };

  EdgeCollapses(const Mesh& mesh, double texture_scale);

  const WedgedSurface<N>& surface() const { return surface_; }
  // None that may be costs less; none at all where none could be.
  std::optional<double> least_cost(std::uint32_t a, std::uint32_t b) const;
  // The cheapest that may be.
  std::optional<Collapse> best(std::uint32_t a, std::uint32_t b) const;
  void apply(const Collapse& c);

 private:
  using Point = PointN<N>;

  void add_planes();
  void add_lines();
  std::optional<Collapse> onto(std::uint32_t from, std::uint32_t to) const;
  bool is_in_texture(const Point& p) const;
  std::vector<Collapse> ways(std::uint32_t a, std::uint32_t b) const;
  TriangleN<N> points_after(std::uint32_t triangle, const Collapse& c) const;
  std::optional<double> price(const Collapse& c) const;
  const Connectivity& connectivity() const { return surface_.connectivity(); }

  WedgedSurface<N> surface_;
  std::vector<Quadric<N>> errors_;  // of each wedge
  Point least_, most_;              // of all texture coordinates
};

extern template class EdgeCollapses<3>;
extern template class EdgeCollapses<5>;

}  // namespace burnish
