// A piece of a mesh laid out flat with as little distortion as its shape allows.
//
// It is projected along its mean normal and then relaxed until each triangle is as nearly congruent to itself in space
// as its neighbours let it be (as rigid as possible; Liu, Zhang, Xu, Gotsman and Gortler, "A local/global approach to
// mesh parameterization", 2008, section 3.3).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

struct FlatChart {
  std::vector<std::uint32_t> triangles;  // of the mesh
  std::vector<Vec2d> points;
  std::vector<Corners> corners;                                  // of each triangle, into points
  std::vector<std::pair<std::uint32_t, std::uint32_t>> borders;  // edges of one triangle only, into points
};

// None where triangles would turn over, borders would cross, or triangles be stretched or squeezed to more than
// kMostStretch times their size in any direction. The area is that of the triangles in space. One triangle is always
// possible.
constexpr double kMostStretch = 1.6;
std::optional<FlatChart> flatten(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);

}  // namespace burnish
