#include "burnish/mesh/atlas/chart_tree.h"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>

#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr double kLeastSeen = 0.85;  // of the area, along the mean normal
constexpr double kRoundness = 2;     // what a ragged border counts against bent triangles

struct Patch {
  Vec3d area_normal;  // the sum of areas times normals
  double area = 0, border = 0;
  std::map<std::uint32_t, double> shared;  // length of the border with each neighbour
  bool alive = true;
};

struct Union {
  double cost;
  std::uint32_t a, b;
  friend bool operator<(const Union& p, const Union& q) {  // the cheapest on top
    return std::tie(p.cost, p.a, p.b) > std::tie(q.cost, q.a, q.b);
  }
};

std::vector<Patch> single_triangles(const Mesh& mesh) {
  const std::vector<std::uint32_t> same = weld(mesh.positions);
  std::vector<Patch> patches(mesh.triangles.size());
  struct Side {
    std::uint32_t triangle;
    bool forward;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); t++) {
    patches[t].area_normal = mesh.perpendicular(t) * 0.5;
    patches[t].area = length(patches[t].area_normal);
    for (int c = 0; c < 3; c++) {
      const std::uint32_t a = same[mesh.triangles[t][c]], b = same[mesh.triangles[t][(c + 1) % 3]];
      patches[t].border += length(mesh.positions[b] - mesh.positions[a]);
      edges[{std::min(a, b), std::max(a, b)}].push_back({t, a < b});
    }
  }
  for (const auto& [ends, sides] : edges) {
    if (sides.size() != 2 || sides[0].forward == sides[1].forward) continue;
    const double edge = length(mesh.positions[ends.second] - mesh.positions[ends.first]);
    patches[sides[0].triangle].shared[sides[1].triangle] += edge;
    patches[sides[1].triangle].shared[sides[0].triangle] += edge;
  }
  return patches;
}

}  // namespace

ChartTree::ChartTree(const Mesh& mesh) : pieces_(mesh.triangles.size(), Piece{kNone, kNone}) {
  std::vector<Patch> patches = single_triangles(mesh);
  std::priority_queue<Union> queue;
  const auto enqueue = [&](std::uint32_t a, std::uint32_t b) {
    const Patch &p = patches[a], &q = patches[b];
    const double area = p.area + q.area, seen = length(p.area_normal + q.area_normal);
    if (!(seen >= kLeastSeen * area)) return;
    const double border = p.border + q.border - 2 * p.shared.at(b);
    const double bent = area > 0 ? 1 - seen / area : 0,
                 ragged = border > 0 ? 1 - 4 * kPi * area / (border * border) : 0;
    queue.push({bent + kRoundness * ragged, std::min(a, b), std::max(a, b)});
  };
  for (std::uint32_t t = 0; t < patches.size(); t++)
    for (const auto& [neighbour, edge] : patches[t].shared)
      if (t < neighbour) enqueue(t, neighbour);
  while (!queue.empty()) {
    const auto [cost, a, b] = queue.top();
    queue.pop();
    if (!patches[a].alive || !patches[b].alive) continue;
    const std::uint32_t joined = std::uint32_t(pieces_.size());
    pieces_.push_back({a, b});
    Patch patch{patches[a].area_normal + patches[b].area_normal,
                patches[a].area + patches[b].area,
                patches[a].border + patches[b].border - 2 * patches[a].shared.at(b),
                {},
                true};
    for (const std::uint32_t part : {a, b}) {
      for (const auto& [neighbour, edge] : patches[part].shared) {
        if (neighbour == a || neighbour == b) continue;
        patch.shared[neighbour] += edge;
        patches[neighbour].shared.erase(part);
        patches[neighbour].shared[joined] += edge;
      }
      patches[part].alive = false;
      patches[part].shared.clear();
    }
    patches.push_back(std::move(patch));
    for (const auto& [neighbour, edge] : patches[joined].shared) enqueue(joined, neighbour);
  }
  for (std::uint32_t i = 0; i < patches.size(); i++)
    if (patches[i].alive) roots_.push_back(i);
}

std::vector<std::uint32_t> ChartTree::triangles(std::uint32_t piece) const {
  std::vector<std::uint32_t> out, open{piece};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    if (is_triangle(at)) out.push_back(at);
    else open.push_back(pieces_[at].one), open.push_back(pieces_[at].two);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace burnish
