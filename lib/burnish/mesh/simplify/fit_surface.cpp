#include "burnish/mesh/simplify/fit_surface.h"

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "burnish/core/parallel.h"
#include "burnish/mesh/conjugate_gradients.h"
#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr int kRounds = 8, kSteps = 60;  // of finding nearest places, and of solving within each
constexpr double kSolved = 1e-16;        // squared residual, as a part of the first
constexpr double kInertia = 0.02;        // of what holds a vertex in place, as a part of what moves it
constexpr double kMostTurn = 0.5;        // cosine between a triangle's normals before and after

// A point of the other mesh: its weight, and where on the mesh it is nearest.
struct Pull {
  double weight = 0;
  Corners vertex{};
  std::array<double, 3> share{};
  Vec3d offset;
};

using Moves = std::vector<Vec3d>;  // of each vertex

std::vector<double> vertex_areas(const Mesh& mesh) {
  std::vector<double> out(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t++)
    for (const std::uint32_t i : mesh.triangles[t]) out[i] += length(mesh.perpendicular(t)) / 6;
  return out;
}

class Fit {
 public:
  Fit(Mesh& mesh, const Mesh& to) : mesh_(mesh), to_(to), areas_(vertex_areas(to)), same_(weld(mesh.positions)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); t++) perpendiculars_.push_back(mesh.perpendicular(t));
    pinned_.resize(mesh.positions.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // of edges, in each direction
    for (const Corners& t : mesh.triangles)
      for (int c = 0; c < 3; c++) {
        const std::uint32_t a = same_[t[c]], b = same_[t[(c + 1) % 3]];
        if (uses[{a, b}]++ > 0) pinned_[a] = pinned_[b] = true;
      }
  }

  void round() {
    find_pulls();
    Moves moves = solved();
    hold_what_would_turn(moves);
    for (std::size_t i = 0; i < same_.size(); i++) mesh_.positions[i] += moves[same_[i]];
  }

 private:
  void find_pulls() {
    const MeshRays rays(mesh_);
    pulls_.assign(to_.positions.size(), {});
    parallel_for(pulls_.size(), [&](std::size_t i) {
      if (!(areas_[i] > 0)) return;  // no triangle has it
      const auto near = rays.nearest(to_.positions[i], std::numeric_limits<double>::max());
      if (!near) return;  // no triangle has area
      const Corners& t = mesh_.triangles[near->point.triangle];
      pulls_[i] = {areas_[i],
                   {same_[t[0]], same_[t[1]], same_[t[2]]},
                   near->point.weight,
                   to_.positions[i] - position_at(mesh_, near->point)};
    });
    inertia_.assign(mesh_.positions.size(), 0);
    for (const Pull& p : pulls_)
      for (int c = 0; c < 3; c++) inertia_[p.vertex[c]] += kInertia * p.weight * p.share[c] * p.share[c];
  }

  // Of moves: what each does to every vertex, through the points between.
  Moves product(const Moves& moves) const {
    Moves out(moves.size());
    for (const Pull& p : pulls_) {
      Vec3d moved;
      for (int c = 0; c < 3; c++) moved += moves[p.vertex[c]] * p.share[c];
      for (int c = 0; c < 3; c++) out[p.vertex[c]] += moved * (p.weight * p.share[c]);
    }
    for (std::size_t i = 0; i < out.size(); i++) out[i] = pinned_[i] ? Vec3d{} : out[i] + moves[i] * inertia_[i];
    return out;
  }

  Moves solved() const {
    Moves moves(mesh_.positions.size()), rest(moves.size());
    for (const Pull& p : pulls_)
      for (int c = 0; c < 3; c++)
        if (!pinned_[p.vertex[c]]) rest[p.vertex[c]] += p.offset * (p.weight * p.share[c]);
    solve_by_conjugate_gradients(moves, rest, kSteps, kSolved * dot(rest, rest),
                                 [&](const Moves& step) { return product(step); });
    return moves;
  }

  void hold_what_would_turn(Moves& moves) const {
    for (bool again = true; again;) {
      again = false;
      for (std::size_t t = 0; t < mesh_.triangles.size(); t++) {
        std::array<Vec3d, 3> p;
        bool moves_at_all = false;
        for (int c = 0; c < 3; c++) {
          const Vec3d& m = moves[same_[mesh_.triangles[t][c]]];
          p[c] = mesh_.position(t, c) + m;
          moves_at_all |= m != Vec3d{};
        }
        const Vec3d &before = perpendiculars_[t], after = cross(p[1] - p[0], p[2] - p[0]);
        if (!moves_at_all || before == Vec3d{} || dot(before, after) > kMostTurn * length(before) * length(after))
          continue;
        for (const std::uint32_t v : mesh_.triangles[t]) moves[same_[v]] = {};
        again = true;
      }
    }
  }

  Mesh& mesh_;
  const Mesh& to_;
  std::vector<double> areas_;
  std::vector<Vec3d> perpendiculars_;  // of the triangles before the first round
  std::vector<std::uint32_t> same_;    // vertices at one place are one
  std::vector<bool> pinned_;
  std::vector<Pull> pulls_;
  std::vector<double> inertia_;
};

}  // namespace

void fit_surface(Mesh& mesh, const Mesh& to, const Progress& progress) {
  Fit fit(mesh, to);
  for (int i = 0; i < kRounds; i++) {
    fit.round();
    report_progress(progress, double(i + 1) / kRounds);
  }
}

}  // namespace burnish
