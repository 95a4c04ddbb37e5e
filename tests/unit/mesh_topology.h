// How the triangles of a mesh hang together, for tests. Positions that coincide are one vertex.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "burnish/mesh/weld.h"

namespace burnish {

// How often each edge is run along, by position, in each direction.
inline std::map<std::pair<std::uint32_t, std::uint32_t>, int> edge_uses(const Mesh& mesh) {
  const std::vector<std::uint32_t> same = weld(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Corners& t : mesh.triangles)
    for (int c = 0; c < 3; c++) uses[{same[t[c]], same[t[(c + 1) % 3]]}]++;
  return uses;
}

// Every edge once in each direction: no holes, no edges of three triangles.
inline bool is_closed(const Mesh& mesh) {
  const auto uses = edge_uses(mesh);
  return std::ranges::all_of(uses, [&](const auto& use) {
    const auto back = uses.find({use.first.second, use.first.first});
    return use.second == 1 && back != uses.end() && back->second == 1;
  });
}

inline int euler_characteristic(const Mesh& mesh) {
  const auto uses = edge_uses(mesh);
  std::set<std::uint32_t> vertices;
  std::size_t edges = 0;
  for (const auto& [edge, count] : uses) {
    vertices.insert(edge.first), vertices.insert(edge.second);
    if (edge.first < edge.second || !uses.count({edge.second, edge.first})) edges++;
  }
  return int(vertices.size()) - int(edges) + int(mesh.triangles.size());
}

}  // namespace burnish
