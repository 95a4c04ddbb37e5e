#include "burnish/mesh/simplify/edge_collapses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish {
namespace {

// Of the squared distance to a vertex's own place, against that to its planes: it decides where those leave it open.
constexpr double kPull = 1e-9;
constexpr double kMostTurn = 0.2;  // cosine between a triangle's normals before and after
// How round a triangle is, 1 being equilateral: below the first a collapse that makes one costs more, below the second
// a triangle has no normal to speak of.
constexpr double kSliver = 0.2, kNeedle = 0.02;
constexpr double kSliverPrice = 100;

template <int N>
Vec3d perpendicular(const TriangleN<N>& p) {
  return cross(position(p[1]) - position(p[0]), position(p[2]) - position(p[0]));
}
template <int N>
double roundness(const TriangleN<N>& p) {
  double squares = 0;
  for (int c = 0; c < 3; c++) {
    const Vec3d edge = position(p[(c + 1) % 3]) - position(p[c]);
    squares += dot(edge, edge);
  }
  return squares > 0 ? 2 * std::sqrt(3.0) * length(perpendicular(p)) / squares : 0;
}
double texture_area(const TriangleN<5>& p) {
  return (p[1][3] - p[0][3]) * (p[2][4] - p[0][4]) - (p[1][4] - p[0][4]) * (p[2][3] - p[0][3]);
}
double texture_area(const TriangleN<3>&) { return 0; }

}  // namespace

template <int N>
EdgeCollapses<N>::EdgeCollapses(const Mesh& mesh, double texture_scale)
    : surface_(mesh, texture_scale), errors_(surface_.wedge_count()), least_(surface_.wedge(0)), most_(least_) {
  for (std::uint32_t w = 0; w < surface_.wedge_count(); w++)
    for (int i = 3; i < N; i++) {
      least_[i] = std::min(least_[i], surface_.wedge(w)[i]);
      most_[i] = std::max(most_[i], surface_.wedge(w)[i]);
    }
  add_planes();
  add_lines();
}

template <int N>
void EdgeCollapses<N>::add_planes() {
  for (std::uint32_t t = 0; t < surface_.triangle_count(); t++) {
    const TriangleN<N> p = surface_.points(t);
    const double area = length(perpendicular(p)) / 2;
    const Point u = normalized(p[1] - p[0]), across = p[2] - p[0] - u * dot(u, p[2] - p[0]);
    if (!(area > 0 && dot(across, across) > 0)) continue;
    const auto plane = Quadric<N>::of_flat(p[0], {u, normalized(across)}, area / 3);
    for (int c = 0; c < 3; c++)
      errors_[surface_.wedges(t)[c]] += plane + Quadric<N>::of_flat(p[c], {}, kPull * area / 3);
  }
}

// Of borders, and of seams with different texture coordinates at both ends; at one alone, the triangles of a pole meet.
template <int N>
void EdgeCollapses<N>::add_lines() {
  for (const auto& [a, b] : connectivity().edges()) {
    const std::vector<std::uint32_t> sides = connectivity().triangles_on(a, b);
    const auto shared = [&](std::uint32_t v) {
      return surface_.wedge_at(sides[0], v) == surface_.wedge_at(sides[1], v);
    };
    if (sides.size() == 2 && (shared(a) || shared(b))) continue;
    for (const std::uint32_t side : sides) {
      const std::uint32_t one = surface_.wedge_at(side, a), two = surface_.wedge_at(side, b);
      const Point along = surface_.wedge(two) - surface_.wedge(one);
      const double squared = dot(along, along);
      if (!(squared > 0)) continue;
      const auto line = Quadric<N>::of_flat(surface_.wedge(one), {normalized(along)}, squared);
      errors_[one] += line, errors_[two] += line;
    }
  }
}

template <int N>
auto EdgeCollapses<N>::onto(std::uint32_t from, std::uint32_t to) const -> std::optional<Collapse> {
  if (surface_.is_locked(from) || (connectivity().is_border(from) && !connectivity().is_border(to))) return {};
  Collapse c{.from = from, .to = to, .merges = surface_.merges(from, to), .cost = 0};
  if (c.merges.empty()) return {};
  for (const auto& m : c.merges) {
    const Point& at = surface_.wedge(m.to);
    c.cost += errors_[m.from](at);
    if (&m == &c.merges[0] || m.to != c.merges[0].to) c.cost += errors_[m.to](at);
  }
  return c;
}

template <int N>
bool EdgeCollapses<N>::is_in_texture(const Point& p) const {
  for (int i = 3; i < N; i++)
    if (p[i] < least_[i] || p[i] > most_[i]) return false;
  return true;
}

// Either vertex onto the other; and where no seam, no border of the texture and no lock holds that, both to where the
// sum of their errors is least. The cheapest first.
template <int N>
auto EdgeCollapses<N>::ways(std::uint32_t a, std::uint32_t b) const -> std::vector<Collapse> {
  std::vector<Collapse> out;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
    if (auto c = onto(from, to)) out.push_back(std::move(*c));
  for (const Collapse& c : out) {
    if (c.merges.size() > 1 || surface_.is_locked(c.to) || !surface_.has_one_wedge(c.to)) continue;
    if (N > 3 && connectivity().is_border(c.to)) continue;  // the texture's border stays where it is
    const auto [goes, stays] = c.merges[0];
    const Quadric<N> sum = errors_[goes] + errors_[stays];
    Collapse free = c;
    free.moved_to = sum.minimum((surface_.wedge(goes) + surface_.wedge(stays)) * 0.5);
    free.cost = sum(*free.moved_to);
    if (is_in_texture(*free.moved_to)) out.push_back(std::move(free));
    break;
  }
  std::ranges::stable_sort(out, {}, &Collapse::cost);
  return out;
}

template <int N>
TriangleN<N> EdgeCollapses<N>::points_after(std::uint32_t triangle, const Collapse& c) const {
  TriangleN<N> out = surface_.points(triangle);
  for (int k = 0; k < 3; k++)
    for (const auto& m : c.merges) {
      const std::uint32_t w = surface_.wedges(triangle)[k];
      if (c.moved_to && (w == m.from || w == m.to)) out[k] = *c.moved_to;
      else if (w == m.from) out[k] = surface_.wedge(m.to);
    }
  return out;
}

// The cost, or more of it where the collapse makes a sliver; none where it may not be.
template <int N>
std::optional<double> EdgeCollapses<N>::price(const Collapse& c) const {
  if (!connectivity().can_collapse(c.from, c.to)) return {};
  std::vector<std::uint32_t> touched = connectivity().triangles_at(c.from);
  if (c.moved_to)
    for (const std::uint32_t t : connectivity().triangles_at(c.to)) touched.push_back(t);
  const std::vector<std::uint32_t> gone = connectivity().triangles_on(c.from, c.to);
  Vec3d mean;
  for (const std::uint32_t t : touched) mean += perpendicular(surface_.points(t));
  double least_before = kSliver, least_after = 1;
  for (const std::uint32_t t : touched) {
    const TriangleN<N> before = surface_.points(t), after = points_after(t, c);
    least_before = std::min(least_before, roundness(before));
    if (std::ranges::find(gone, t) != gone.end()) continue;
    const Vec3d n = roundness(before) < kNeedle ? mean : perpendicular(before), m = perpendicular(after);
    if (!(dot(n, m) > kMostTurn * length(n) * length(m))) return {};
    if (const double area = texture_area(before); area != 0 && !(texture_area(after) * (area > 0 ? 1 : -1) > 0))
      return {};
    least_after = std::min(least_after, roundness(after));
  }
  return c.cost * (least_after < least_before ? kSliverPrice : 1);
}

template <int N>
auto EdgeCollapses<N>::best(std::uint32_t a, std::uint32_t b) const -> std::optional<Collapse> {
  std::optional<Collapse> out;
  for (Collapse& c : ways(a, b)) {
    if (out && c.cost >= out->cost) continue;
    if (const auto cost = price(c); cost && (!out || *cost < out->cost)) {
      out = std::move(c);
      out->cost = *cost;
    }
  }
  return out;
}

template <int N>
std::optional<double> EdgeCollapses<N>::least_cost(std::uint32_t a, std::uint32_t b) const {
  const std::vector<Collapse> all = ways(a, b);
  return all.empty() ? std::nullopt : std::optional(all[0].cost);
}

template <int N>
void EdgeCollapses<N>::apply(const Collapse& c) {
  for (const auto& m : c.merges) errors_[m.to] += errors_[m.from];
  if (c.moved_to) surface_.wedge(c.merges[0].to) = *c.moved_to;
  surface_.collapse(c.from, c.to, c.merges);
}

template class EdgeCollapses<3>;
template class EdgeCollapses<5>;

}  // namespace burnish
