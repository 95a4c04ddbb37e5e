// A surface whose edges collapse, with what its vertices hold on each side of the texture's seams.
//
// What a vertex holds on one side of its seams is a wedge: a point in N dimensions, of which the first three are the
// position; of five, the last two are texture coordinates in lengths of the surface. Internal to decimation.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "burnish/mesh/simplify/connectivity.h"
#include "burnish/mesh/simplify/quadric.h"
#include "burnish/mesh/weld.h"

namespace burnish {

template <int N>
using TriangleN = std::array<PointN<N>, 3>;

template <int N>
Vec3d position(const PointN<N>& p) {
  return {p[0], p[1], p[2]};
}

template <int N>
class WedgedSurface {
  static_assert(N == 3 || N == 5);

 public:
  using Point = PointN<N>;
  // Of a wedge of the vertex that goes into one of that which stays.
  struct Merge {
    std::uint32_t from, to;
  };

  // Positions that coincide are one vertex; positions are taken relative to the centre.
  WedgedSurface(const Mesh& mesh, double texture_scale);
  Mesh to_mesh(const std::string& name) const;

  std::size_t triangle_count() const { return triangle_count_; }
  std::size_t vertex_count() const { return locked_.size(); }  // of the numbers given out, like the next
  std::size_t wedge_count() const { return wedges_.size(); }
  const Connectivity& connectivity() const { return connectivity_; }
  bool is_locked(std::uint32_t vertex) const { return locked_[vertex]; }
  Point& wedge(std::uint32_t w) { return wedges_[w]; }
  const Point& wedge(std::uint32_t w) const { return wedges_[w]; }
  const Corners& wedges(std::uint32_t triangle) const { return triangles_[triangle].wedge; }
  TriangleN<N> points(std::uint32_t triangle) const {
    const Corners& w = triangles_[triangle].wedge;
    return {wedges_[w[0]], wedges_[w[1]], wedges_[w[2]]};
  }
  std::uint32_t wedge_at(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& t = triangles_[triangle];
    return t.wedge[t.vertex[0] == vertex ? 0 : t.vertex[1] == vertex ? 1 : 2];
  }
  bool has_one_wedge(std::uint32_t vertex) const;

  // One, or two of an edge on a seam; none where the texture would tear: where another seam leaves the vertex that
  // goes, or one ends there.
  std::vector<Merge> merges(std::uint32_t from, std::uint32_t to) const;
  void collapse(std::uint32_t from, std::uint32_t to, const std::vector<Merge>& merges);

 private:
  struct Triangle {
    Corners vertex, wedge;
  };
  void add_triangle(Corners vertex, Corners wedge);

  static constexpr std::uint32_t kNone = ~0u;
  Connectivity connectivity_;
  std::vector<Point> wedges_;
  std::vector<Triangle> triangles_;
  std::vector<bool> locked_;  // a vertex each
  std::size_t triangle_count_ = 0;
  double texture_scale_;
  Vec3d centre_;
};

template <int N>
WedgedSurface<N>::WedgedSurface(const Mesh& mesh, double texture_scale)
    : texture_scale_(texture_scale), centre_(bounds(mesh).centre()) {
  const std::vector<std::uint32_t> same_position = weld(mesh.positions), same_uv = weld(mesh.uvs);
  std::vector<Corners> corners;  // position, texture coordinates, nothing
  for (std::size_t t = 0; t < mesh.triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      corners.push_back({same_position[mesh.triangles[t][c]], N == 5 ? same_uv[mesh.triangle_uvs[t][c]] : 0, 0});
  const std::vector<std::uint32_t> first = weld(corners);
  std::vector<std::uint32_t> vertex_of(mesh.positions.size(), kNone), wedge_of(corners.size(), kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    Corners vertex, wedge;
    for (int c = 0; c < 3; c++) {
      const auto& [place, uv, nothing] = corners[3 * t + c];
      std::uint32_t &v = vertex_of[place], &w = wedge_of[first[3 * t + c]];
      if (v == kNone) v = connectivity_.add_vertex(), locked_.push_back(false);
      if (w == kNone) {
        w = std::uint32_t(wedges_.size());
        const Vec3d p = mesh.positions[place] - centre_;
        Point& at = wedges_.emplace_back();
        at[0] = p.x, at[1] = p.y, at[2] = p.z;
        if (N == 5) at[N - 2] = mesh.uvs[uv].x * texture_scale, at[N - 1] = mesh.uvs[uv].y * texture_scale;
      }
      vertex[c] = v, wedge[c] = w;
    }
    if (vertex[0] != vertex[1] && vertex[1] != vertex[2] && vertex[2] != vertex[0]) add_triangle(vertex, wedge);
  }
  triangle_count_ = triangles_.size();
}

// One that the surface cannot take gets vertices of its own, and all that lie there keep their places.
template <int N>
void WedgedSurface<N>::add_triangle(Corners vertex, Corners wedge) {
  if (!connectivity_.add_triangle(vertex)) {
    for (int c = 0; c < 3; c++) {
      locked_[vertex[c]] = true;
      vertex[c] = connectivity_.add_vertex();
      locked_.push_back(true);
      wedges_.push_back(Point(wedges_[wedge[c]]));
      wedge[c] = std::uint32_t(wedges_.size()) - 1;
    }
    connectivity_.add_triangle(vertex);
  }
  triangles_.push_back({vertex, wedge});
}

template <int N>
bool WedgedSurface<N>::has_one_wedge(std::uint32_t vertex) const {
  if (N == 3) return true;
  const std::vector<std::uint32_t> triangles = connectivity_.triangles_at(vertex);
  return std::ranges::all_of(triangles,
                             [&](std::uint32_t t) { return wedge_at(t, vertex) == wedge_at(triangles[0], vertex); });
}

template <int N>
auto WedgedSurface<N>::merges(std::uint32_t from, std::uint32_t to) const -> std::vector<Merge> {
  std::vector<Merge> out;
  for (const std::uint32_t t : connectivity_.triangles_on(from, to)) {
    const Merge merge{wedge_at(t, from), wedge_at(t, to)};
    if (out.empty() || out[0].from != merge.from) out.push_back(merge);
    else if (out[0].to != merge.to) return {};
  }
  if (N == 3) return out;
  for (const std::uint32_t t : connectivity_.triangles_at(from))
    if (std::ranges::find(out, wedge_at(t, from), &Merge::from) == out.end()) return {};
  return out;
}

template <int N>
void WedgedSurface<N>::collapse(std::uint32_t from, std::uint32_t to, const std::vector<Merge>& merges) {
  triangle_count_ -= connectivity_.triangles_on(from, to).size();
  for (const std::uint32_t t : connectivity_.triangles_at(from))
    for (int c = 0; c < 3; c++)
      if (Triangle& triangle = triangles_[t]; triangle.vertex[c] == from) {
        triangle.vertex[c] = to;
        triangle.wedge[c] = std::ranges::find(merges, triangle.wedge[c], &Merge::from)->to;
      }
  connectivity_.collapse(from, to);
}

template <int N>
Mesh WedgedSurface<N>::to_mesh(const std::string& name) const {
  Mesh out;
  out.name = name;
  std::vector<std::uint32_t> position_of(locked_.size(), kNone), uv_of(wedges_.size(), kNone);
  for (std::uint32_t t = 0; t < triangles_.size(); t++) {
    if (!connectivity_.has_triangle(t)) continue;
    Corners triangle, uv;
    for (int c = 0; c < 3; c++) {
      const Point& at = wedges_[triangles_[t].wedge[c]];
      std::uint32_t &p = position_of[triangles_[t].vertex[c]], &w = uv_of[triangles_[t].wedge[c]];
      if (p == kNone) p = std::uint32_t(out.positions.size()), out.positions.push_back(position(at) + centre_);
      if (N == 5 && w == kNone) {
        w = std::uint32_t(out.uvs.size());
        out.uvs.push_back({at[N - 2] / texture_scale_, at[N - 1] / texture_scale_});
      }
      triangle[c] = p, uv[c] = w;
    }
    out.triangles.push_back(triangle);
    if (N == 5) out.triangle_uvs.push_back(uv);
  }
  return out;
}

}  // namespace burnish
