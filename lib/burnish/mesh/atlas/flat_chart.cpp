#include "burnish/mesh/atlas/flat_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "burnish/mesh/conjugate_gradients.h"

namespace burnish {
namespace {

constexpr int kRounds = 40, kSteps = 30;  // of relaxing, and of solving within each
constexpr double kSolved = 1e-24;         // squared residual over that of edges left alone
constexpr double kFlat = 1e-9;            // area over squared edges: below it a triangle has no shape to keep

Vec2d turned(Vec2d v, Vec2d rotation) {
  return {v.x * rotation.x - v.y * rotation.y, v.x * rotation.y + v.y * rotation.x};
}

// A triangle as it is in space, in a plane of its own: corners, and half the cotangents of their angles.
struct Shape {
  std::array<Vec2d, 3> corner{};
  std::array<double, 3> weight{};
  double area2 = 0;
};

Shape shape_of(const Mesh& mesh, std::uint32_t t) {
  Shape s;
  const Vec3d a = mesh.position(t, 0), ab = mesh.position(t, 1) - a, ac = mesh.position(t, 2) - a, n = cross(ab, ac);
  const double base = length(ab);
  if (!(length(n) > kFlat * (dot(ab, ab) + dot(ac, ac)))) return s;
  s.area2 = length(n);
  s.corner = {Vec2d{0, 0}, Vec2d{base, 0}, Vec2d{dot(ab, ac) / base, s.area2 / base}};
  for (int c = 0; c < 3; c++)
    s.weight[c] = 0.5 * dot(s.corner[(c + 1) % 3] - s.corner[c], s.corner[(c + 2) % 3] - s.corner[c]) / s.area2;
  return s;
}

// Solves for the points whose edges come nearest, by weight, to the wanted ones.
class Relaxation {
 public:
  Relaxation(const FlatChart& chart, const std::vector<Shape>& shapes) : chart_(chart), shapes_(shapes) {
    for_each_edge(
        [&](std::size_t, std::uint32_t, std::uint32_t, Vec2d edge, double w) { size_ += dot(edge, edge) * w * w; });
  }

  void round(std::vector<Vec2d>& points) const {
    std::vector<Vec2d> residual(points.size());
    for_each_edge([&](std::size_t t, std::uint32_t a, std::uint32_t b, Vec2d edge, double w) {
      const Vec2d error = (turned(edge, rotation(t, points)) - (points[b] - points[a])) * w;
      residual[b] = residual[b] + error, residual[a] = residual[a] - error;
    });
    solve_by_conjugate_gradients(points, residual, kSteps, kSolved * size_,
                                 [&](const std::vector<Vec2d>& step) { return laplacian(step); });
  }

 private:
  std::vector<Vec2d> laplacian(const std::vector<Vec2d>& points) const {
    std::vector<Vec2d> out(points.size());
    for_each_edge([&](std::size_t, std::uint32_t a, std::uint32_t b, Vec2d, double w) {
      const Vec2d d = (points[b] - points[a]) * w;
      out[b] = out[b] + d, out[a] = out[a] - d;
    });
    return out;
  }
  // Body(triangle, from, to, the edge in the triangle's own plane, weight).
  template <typename Body>
  void for_each_edge(const Body& body) const {
    for (std::size_t t = 0; t < shapes_.size(); t++)
      for (int c = 0; c < 3; c++) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        body(t, chart_.corners[t][a], chart_.corners[t][b], shapes_[t].corner[b] - shapes_[t].corner[a],
             shapes_[t].weight[c]);
      }
  }
  // That takes a triangle's own plane nearest to where it lies now, as a unit complex number.
  Vec2d rotation(std::size_t t, const std::vector<Vec2d>& points) const {
    Vec2d r;
    for (int c = 0; c < 3; c++) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      const Vec2d own = shapes_[t].corner[b] - shapes_[t].corner[a],
                  now = points[chart_.corners[t][b]] - points[chart_.corners[t][a]];
      r = r + Vec2d{dot(own, now), cross(own, now)} * shapes_[t].weight[c];
    }
    const double size = std::sqrt(dot(r, r));
    return size > 0 ? r * (1 / size) : Vec2d{1, 0};
  }

  const FlatChart& chart_;
  const std::vector<Shape>& shapes_;
  double size_ = 0;
};

FlatChart projected(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  FlatChart chart;
  chart.triangles = triangles;
  Vec3d normal;
  for (const std::uint32_t t : triangles) normal += mesh.perpendicular(t);
  if (!(length(normal) > 0)) normal = {0, 0, 1};
  normal = normalized(normal);
  const Vec3d axis = std::abs(normal.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d right = normalized(cross(axis, normal)), up = cross(normal, right);
  std::map<std::tuple<double, double, double>, std::uint32_t> number;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::uint32_t t : triangles) {
    Corners& corners = chart.corners.emplace_back();
    for (int c = 0; c < 3; c++) {
      const Vec3d p = mesh.position(t, c);
      const auto [at, added] = number.try_emplace({p.x, p.y, p.z}, std::uint32_t(chart.points.size()));
      if (added) chart.points.push_back({dot(p, right), dot(p, up)});
      corners[c] = at->second;
    }
    for (int c = 0; c < 3; c++) edges.emplace(corners[c], corners[(c + 1) % 3]);
  }
  for (const auto& [a, b] : edges)
    if (!edges.count({b, a})) chart.borders.emplace_back(a, b);
  return chart;
}

double turn(Vec2d a, Vec2d b, Vec2d c) { return cross(b - a, c - a); }

bool cross_each_other(const FlatChart& chart, std::size_t i, std::size_t j) {
  const auto [a, b] = chart.borders[i];
  const auto [c, d] = chart.borders[j];
  if (a == c || a == d || b == c || b == d) return false;
  const Vec2d pa = chart.points[a], pb = chart.points[b], pc = chart.points[c], pd = chart.points[d];
  if (std::max(pa.x, pb.x) < std::min(pc.x, pd.x) || std::max(pc.x, pd.x) < std::min(pa.x, pb.x)) return false;
  if (std::max(pa.y, pb.y) < std::min(pc.y, pd.y) || std::max(pc.y, pd.y) < std::min(pa.y, pb.y)) return false;
  return (turn(pa, pb, pc) >= 0) != (turn(pa, pb, pd) >= 0) && (turn(pc, pd, pa) >= 0) != (turn(pc, pd, pb) >= 0);
}

// The larger of how far a triangle is stretched and how far squeezed; infinite where it is turned over.
double stretch(const Shape& s, const std::array<Vec2d, 3>& p) {
  const double area2 = turn(p[0], p[1], p[2]);
  if (!(area2 > 0)) return std::numeric_limits<double>::infinity();
  // The map's columns, along and across the first edge; its singular values from their squares.
  const Vec2d along = (p[1] - p[0]) * (1 / s.corner[1].x),
              across = (p[2] - p[0] - along * s.corner[2].x) * (1 / s.corner[2].y);
  const double half_trace = (dot(along, along) + dot(across, across)) / 2, determinant = cross(along, across);
  const double most =
      std::sqrt(half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - determinant * determinant)));
  return std::max(most, most / determinant);
}

// Of a needle, which has no shape to keep, by more than what counts as flat.
bool is_turned_over(const std::array<Vec2d, 3>& p) {
  const Vec2d ab = p[1] - p[0], ac = p[2] - p[0];
  return cross(ab, ac) < -kFlat * (dot(ab, ab) + dot(ac, ac));
}

// No triangle turned over and no border across another. That leaves no overlaps but those of borders that fold back at
// an end they share, and of a chart that winds round twice within one border.
bool is_sound(const FlatChart& chart, const std::vector<Shape>& shapes) {
  for (std::size_t t = 0; t < shapes.size(); t++) {
    const Corners& c = chart.corners[t];
    const std::array<Vec2d, 3> p{chart.points[c[0]], chart.points[c[1]], chart.points[c[2]]};
    if (shapes[t].area2 > 0 ? !(stretch(shapes[t], p) <= kMostStretch) : is_turned_over(p)) return false;
  }
  for (std::size_t i = 0; i < chart.borders.size(); i++)
    for (std::size_t j = 0; j < i; j++)
      if (cross_each_other(chart, i, j)) return false;
  return true;
}

}  // namespace

std::optional<FlatChart> flatten(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  FlatChart chart = projected(mesh, triangles);
  std::vector<Shape> shapes;
  for (const std::uint32_t t : triangles) shapes.push_back(shape_of(mesh, t));
  const Relaxation relaxation(chart, shapes);
  for (int i = 0; i < kRounds; i++) relaxation.round(chart.points);
  double area2 = 0, wanted = 0;
  for (std::size_t t = 0; t < shapes.size(); t++) {
    const Corners& c = chart.corners[t];
    wanted += shapes[t].area2;
    area2 += turn(chart.points[c[0]], chart.points[c[1]], chart.points[c[2]]);
  }
  if (area2 > 0)
    for (Vec2d& p : chart.points) p = p * std::sqrt(wanted / area2);
  if (triangles.size() > 1 && !is_sound(chart, shapes)) return {};
  return chart;
}

}  // namespace burnish
