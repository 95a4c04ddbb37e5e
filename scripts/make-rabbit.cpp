// Makes a rabbit of rounded lumps, for samples where there is no other mesh.
//
//   make-rabbit OUT.obj
//
// The surface is where a smooth union of ellipsoids is 0, found in a grid of tetrahedra: closed, some 40,000 triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/mesh.h"
#include "program.h"

using namespace burnish;

namespace {

struct Lump {
  Vec3d centre, radii;
};

// Body, haunches, chest, head, snout, feet, tail. It looks to −x, and y is up; what has z stands on both sides.
constexpr std::array<Lump, 9> kLumps{{{{0.22, -0.38, 0}, {0.62, 0.54, 0.46}},
                                      {{0.42, -0.52, 0.30}, {0.40, 0.42, 0.26}},
                                      {{-0.34, -0.30, 0}, {0.32, 0.46, 0.34}},
                                      {{-0.50, 0.26, 0}, {0.33, 0.29, 0.27}},
                                      {{-0.74, 0.16, 0}, {0.20, 0.17, 0.18}},
                                      {{-0.48, -0.86, 0.19}, {0.26, 0.12, 0.13}},
                                      {{0.22, -0.88, 0.36}, {0.36, 0.11, 0.15}},
                                      {{0.84, -0.48, 0}, {0.16, 0.16, 0.16}},
                                      {{-0.46, -0.62, 0.19}, {0.13, 0.30, 0.13}}}};

double smooth_least(double a, double b) {
  constexpr double kBlend = 0.09;
  const double h = std::max(0.0, kBlend - std::abs(a - b)) / kBlend;
  return std::min(a, b) - h * h * kBlend / 4;
}

double ellipsoid(Vec3d p, const Lump& lump) {
  p = p - lump.centre;
  const Vec3d q{p.x / lump.radii.x, p.y / lump.radii.y, p.z / lump.radii.z};
  return (length(q) - 1) * std::min({lump.radii.x, lump.radii.y, lump.radii.z});
}

// A flattened spoon from the head upwards and back.
double ear(Vec3d p) {
  const Vec3d root{-0.40, 0.44, 0.11}, tip{0.10, 0.90, 0.24};
  const Vec3d along = normalized(tip - root), flat = normalized(cross(along, {0, 0, 1}));
  const Vec3d from = p - (root + tip) * 0.5;
  const double half = length(tip - root) / 2, s = dot(from, along) / half;
  const double a = dot(from, flat), b = dot(from, cross(along, flat));
  const double hollow = 0.035 * (1 - s * s);  // in front
  return (std::sqrt(s * s * 0.92 + a * a / (0.14 * 0.14) + std::pow((b + hollow) / 0.085, 2)) - 1) * 0.08;
}

// Negative inside.
double rabbit(Vec3d p) {
  p.z = std::abs(p.z);
  double d = ear(p);
  for (const Lump& lump : kLumps) d = smooth_least(d, ellipsoid(p, lump));
  return std::max(d, -0.97 - p.y);  // it sits on the ground
}

// Each cube of the grid is six tetrahedra round its diagonal; the surface cuts each in one or two triangles.
class Polygonizer {
 public:
  Mesh run() {
    for (int i = 0; i < kCells; i++)
      for (int j = 0; j < kCells; j++)
        for (int k = 0; k < kCells; k++) cube(i, j, k);
    return std::move(mesh_);
  }

 private:
  static constexpr int kCells = 64;
  static constexpr double kHalf = 1.1;
  struct Corner {
    int id;
    Vec3d place;
    double value;
  };

  static Corner corner(int i, int j, int k) {
    const Vec3d p = Vec3d{double(i), double(j), double(k)} * (2 * kHalf / kCells) - Vec3d{kHalf, kHalf, kHalf};
    double value = rabbit(p);
    if (std::abs(value) < 1e-4) value = 1e-4;  // no slivers at corners
    return {(i * (kCells + 1) + j) * (kCells + 1) + k, p, value};
  }

  void cube(int i, int j, int k) {
    static constexpr std::array<std::array<int, 3>, 6> kAxes{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (const auto& axes : kAxes) {  // from one end of the diagonal to the other, along the axes in this order
      std::array<int, 3> at{i, j, k};
      std::array<Corner, 4> tetrahedron;
      tetrahedron[0] = corner(i, j, k);
      for (int step = 0; step < 3; step++) {
        at[axes[step]]++;
        tetrahedron[step + 1] = corner(at[0], at[1], at[2]);
      }
      cut(tetrahedron);
    }
  }

  void cut(const std::array<Corner, 4>& t) {
    std::vector<Corner> inside, outside;
    for (const Corner& c : t) (c.value < 0 ? inside : outside).push_back(c);
    const auto& [few, many] = inside.size() <= outside.size() ? std::tie(inside, outside) : std::tie(outside, inside);
    if (few.size() == 1) {
      triangle(vertex(few[0], many[0]), vertex(few[0], many[1]), vertex(few[0], many[2]), inside[0], outside[0]);
    } else if (few.size() == 2) {
      const std::uint32_t a = vertex(few[0], many[0]), b = vertex(few[0], many[1]), c = vertex(few[1], many[1]),
                          d = vertex(few[1], many[0]);
      triangle(a, b, c, inside[0], outside[0]), triangle(a, c, d, inside[0], outside[0]);
    }
  }

  // Where the value is 0 on an edge; edges are shared.
  std::uint32_t vertex(const Corner& a, const Corner& b) {
    const auto [found, added] = vertices_.emplace(std::minmax(a.id, b.id), std::uint32_t(mesh_.positions.size()));
    if (added) mesh_.positions.push_back(a.place + (b.place - a.place) * (a.value / (a.value - b.value)));
    return found->second;
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Corner& in, const Corner& out) {
    const Vec3d n = cross(mesh_.positions[b] - mesh_.positions[a], mesh_.positions[c] - mesh_.positions[a]);
    if (dot(n, out.place - in.place) < 0) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  Mesh mesh_;
  std::map<std::pair<int, int>, std::uint32_t> vertices_;
};

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-rabbit OUT.obj", argc, argv,
                     [](const Arguments& a) { write_mesh(a[0], MeshFileType::kObj, Polygonizer().run()); });
}
