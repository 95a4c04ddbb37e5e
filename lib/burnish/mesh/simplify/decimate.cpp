#include "burnish/mesh/simplify/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/simplify/edge_collapses.h"
#include "burnish/mesh/simplify/fit_surface.h"

namespace burnish {
namespace {

// Collapses edges, the cheapest first.
template <int N>
class Decimation {
 public:
  Decimation(const Mesh& mesh, double texture_scale);
  void run(std::size_t target, const Progress& progress);
  const WedgedSurface<N>& surface() const { return collapses_.surface(); }

 private:
  struct Queued {
    double cost;
    std::uint32_t a, b;
    unsigned changes;
    friend bool operator<(const Queued& p, const Queued& q) {  // the cheapest on top
      return std::tie(p.cost, p.a, p.b) > std::tie(q.cost, q.a, q.b);
    }
  };

  void reduce(std::size_t target, bool borders_only, const Progress& progress);
  const Connectivity& connectivity() const { return surface().connectivity(); }
  unsigned changes(std::uint32_t a, std::uint32_t b) const { return changes_[a] + changes_[b]; }

  EdgeCollapses<N> collapses_;
  std::vector<unsigned> changes_;  // of each vertex's place
  double most_cost_;               // beyond that of any collapse
};

template <int N>
Decimation<N>::Decimation(const Mesh& mesh, double texture_scale)
    : collapses_(mesh, texture_scale), changes_(surface().vertex_count()) {
  const double diagonal = bounds(mesh).diagonal();
  most_cost_ = 1e3 * diagonal * diagonal * diagonal * diagonal;
}

// What is refused stays in the queue at twice its cost: later the neighbours may have changed.
template <int N>
void Decimation<N>::reduce(std::size_t target, bool borders_only, const Progress& progress) {
  const std::size_t total = surface().triangle_count();
  std::priority_queue<Queued> queue;
  const auto enqueue = [&](std::uint32_t a, std::uint32_t b) {
    if (borders_only && connectivity().triangles_on(a, b).size() > 1) return;
    if (const auto cost = collapses_.least_cost(a, b)) queue.push({*cost, a, b, changes(a, b)});
  };
  if (total > target)
    for (const auto& [a, b] : connectivity().edges()) enqueue(a, b);
  while (surface().triangle_count() > target && !queue.empty()) {
    Queued q = queue.top();
    queue.pop();
    if (!connectivity().has_vertex(q.a) || !connectivity().has_vertex(q.b) || changes(q.a, q.b) != q.changes) continue;
    const auto c = collapses_.best(q.a, q.b);
    if (c && c->cost <= q.cost) {
      collapses_.apply(*c);
      changes_[c->to]++;
      for (const std::uint32_t n : connectivity().neighbours(c->to)) enqueue(c->to, n);
      const std::size_t left = surface().triangle_count();
      if (left % 1024 < 2) report_progress(progress, double(total - left) / double(total - target));
    } else {
      q.cost = c ? c->cost : std::max(2 * q.cost, 1e-18 * most_cost_);
      if (q.cost < most_cost_) queue.push(q);
    }
  }
}

// A border gives single triangles, so that the number can be met exactly.
template <int N>
void Decimation<N>::run(std::size_t target, const Progress& progress) {
  reduce(target + 1, false, progress);
  reduce(target, true, {});
  reduce(target, false, {});
}

// Lengths on the surface for lengths in the texture, over the whole mesh.
double texture_scale(const Mesh& mesh) {
  double surface = 0, texture = 0;
  for (std::size_t t = 0; t < mesh.triangle_uvs.size(); t++) {
    surface += length(mesh.perpendicular(t));
    texture += std::abs(cross(mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0)));
  }
  return surface > 0 && texture > 0 ? std::sqrt(surface / texture) : 1;
}

template <int N>
Mesh decimated(const Mesh& mesh, double scale, std::size_t faces, const Progress& progress) {
  Decimation<N> decimation(mesh, scale);
  decimation.run(faces, progress);
  return decimation.surface().to_mesh(mesh.name);
}

DecimateStats measure(const Mesh& original, const Mesh& result) {
  DecimateStats stats{.faces = result.triangles.size(), .vertices = result.positions.size()};
  const MeshRays rays(result);
  std::vector<std::uint32_t> vertices;
  for (const Corners& triangle : original.triangles) vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<double> distance(vertices.size());
  parallel_for(distance.size(), [&](std::size_t i) {
    const auto near = rays.nearest(original.positions[vertices[i]], std::numeric_limits<double>::max());
    if (!near) throw file_error(ErrorKind::kMalformed, original.name, "expected triangles with area, got none");
    distance[i] = near->distance;
  });
  double squares = 0;
  for (const double d : distance) squares += d * d, stats.max_distance = std::max(stats.max_distance, d);
  stats.rms_distance = std::sqrt(squares / double(distance.size()));
  return stats;
}

}  // namespace

Mesh decimate(const Mesh& mesh, std::size_t faces, DecimateStats* stats, const Progress& progress) {
  require_traceable(mesh);
  Mesh out;
  if (faces >= mesh.triangles.size()) {
    out = mesh;
  } else if (mesh.has_uvs()) {
    out = decimated<5>(mesh, texture_scale(mesh), faces, progress);
  } else {
    out = decimated<3>(mesh, 1, faces, [&](double f) { report_progress(progress, 0.5 * f); });
    fit_surface(out, mesh, [&](double f) { report_progress(progress, 0.5 + 0.5 * f); });
  }
  add_smooth_normals(out);
  if (stats) *stats = measure(mesh, out);
  report_progress(progress, 1);
  return out;
}

}  // namespace burnish
