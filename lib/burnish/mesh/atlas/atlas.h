// Texture coordinates for a mesh that has none: an atlas, each place of the surface at a place of its own.
//
// The triangles are grouped into nearly flat pieces (chart_tree.h), each piece is laid out flat (flat_chart.h), or its
// parts are where it cannot be, and the charts are packed into the unit square (chart_packing.h), all at one scale.
#pragma once

#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

struct AtlasStats {
  std::size_t charts = 0;
  double covered = 0;  // of the unit square, by charts
};

// Sets uvs and triangle_uvs. At `size` × `size` texels, charts are at least two texels apart and two from the border.
// kMalformed where the charts do not fit into so few texels. Runs on one thread; depends on mesh and size alone.
AtlasStats add_atlas(Mesh& mesh, int size, const Progress& progress = {});

}  // namespace burnish
