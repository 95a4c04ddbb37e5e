// Makes a detailed mesh of a plain one: Loop subdivision, then smooth noise and ridges along the normals.
//
//   make-detailed-mesh IN OUT.obj [LEVELS]      each level has four times the faces; 3 by default
//
// C. Loop, "Smooth subdivision surfaces based on triangles", 1987, with the weights of Warren. The noise comes from an
// integer hash, so that the mesh is the same everywhere.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/mesh.h"
#include "burnish/mesh/weld.h"
#include "noise.h"
#include "program.h"

using namespace burnish;

namespace {

// Positions and triangles alone, each position once.
Mesh plain(const Mesh& in) {
  const std::vector<std::uint32_t> first = weld(in.positions);
  std::vector<std::uint32_t> number(in.positions.size());
  Mesh out;
  out.name = in.name;
  for (std::size_t i = 0; i < in.positions.size(); i++) {
    if (first[i] != i) continue;
    number[i] = std::uint32_t(out.positions.size());
    out.positions.push_back(in.positions[i]);
  }
  for (const Corners& t : in.triangles)
    out.triangles.push_back({number[first[t[0]]], number[first[t[1]]], number[first[t[2]]]});
  return out;
}

struct Edge {
  std::uint32_t midpoint = 0;
  std::array<std::uint32_t, 2> opposite{};  // corners of the triangles beside it
  int triangles = 0;
};
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, Edge>;

Edges edges_of(const Mesh& mesh) {
  Edges edges;
  for (const Corners& t : mesh.triangles)
    for (int c = 0; c < 3; c++) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      Edge& e = edges[{std::min(a, b), std::max(a, b)}];
      if (e.triangles < 2) e.opposite[e.triangles] = t[(c + 2) % 3];
      e.triangles++;
    }
  std::uint32_t next = std::uint32_t(mesh.positions.size());
  for (auto& [ends, e] : edges) e.midpoint = next++;
  return edges;
}

Mesh subdivided(const Mesh& mesh) {
  Edges edges = edges_of(mesh);
  struct Ring {
    Vec3d sum, border_sum;
    int count = 0, border_count = 0;
  };
  std::vector<Ring> rings(mesh.positions.size());
  Mesh out;
  out.name = mesh.name;
  out.positions.resize(mesh.positions.size());
  for (const auto& [ends, e] : edges) {
    const Vec3d a = mesh.positions[ends.first], b = mesh.positions[ends.second];
    const bool border = e.triangles != 2;
    out.positions.push_back(border ? (a + b) * 0.5
                                   : (a + b) * 0.375 +
                                         (mesh.positions[e.opposite[0]] + mesh.positions[e.opposite[1]]) * 0.125);
    for (const auto& [at, other] : {std::pair(ends.first, b), std::pair(ends.second, a)}) {
      Ring& ring = rings[at];
      ring.sum += other, ring.count++;
      if (border) ring.border_sum += other, ring.border_count++;
    }
  }
  for (std::size_t i = 0; i < mesh.positions.size(); i++) {
    const Ring& r = rings[i];
    const double weight = r.count == 3 ? 3.0 / 16 : 3.0 / (8 * std::max(1, r.count));
    if (r.border_count == 0) out.positions[i] = mesh.positions[i] * (1 - weight * r.count) + r.sum * weight;
    else if (r.border_count == 2) out.positions[i] = mesh.positions[i] * 0.75 + r.border_sum * 0.125;
    else out.positions[i] = mesh.positions[i];
  }
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    return edges[{std::min(a, b), std::max(a, b)}].midpoint;
  };
  for (const Corners& t : mesh.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    for (const Corners& part : {Corners{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}})
      out.triangles.push_back(part);
  }
  return out;
}

// Along the normal, in parts of the mesh's diagonal.
double detail(Vec3d p) {
  const Vec3d bent = p + Vec3d{noise(p * 9.0, 1), noise(p * 9.0, 2), noise(p * 9.0, 3)} * 0.02;
  const double ridge = 1 - std::abs(turbulence(bent * 22.0, 2, 4)) * 3;
  return 0.0045 * std::max(-0.5, ridge) + 0.006 * turbulence(p * 14.0, 4, 8);
}

void displace(Mesh& mesh) {
  add_smooth_normals(mesh);
  const Bounds box = bounds(mesh);
  const double size = box.diagonal();
  for (std::size_t i = 0; i < mesh.positions.size(); i++)
    mesh.positions[i] += mesh.normals[i] * (size * detail((mesh.positions[i] - box.centre()) / size));
  mesh.normals.clear(), mesh.triangle_normals.clear();
  add_smooth_normals(mesh);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-detailed-mesh IN OUT.obj [LEVELS]", argc, argv, [](const Arguments& a) {
    const int levels = integer_argument(a, 2, 3, 0, 6);
    Mesh mesh = plain(read_mesh(a[0]));
    for (int i = 0; i < levels; i++) mesh = subdivided(mesh);
    displace(mesh);
    write_mesh(a[1], MeshFileType::kObj, mesh);
  });
}
