// Fewer triangles for the same shape: edges collapse in the order of their quadric error.
//
// Each vertex carries the squared distances, weighted by area, to the planes of the triangles that went into it, and to
// the lines of the borders among them; an edge collapses to the point where the sum of both ends' is least (Garland and
// Heckbert, "Surface simplification using quadric error metrics", 1997). Positions that coincide are one vertex. A
// collapse is refused where it would change the topology, turn a triangle over, or make a sliver.
//
// Then the vertices move once more, so that the surface as a whole lies nearest to the original (fit_surface.h).
//
// A mesh with texture coordinates is simplified in five dimensions, position and texture together (Garland and
// Heckbert, "Simplifying surfaces with color and texture", 1998), so that the texture keeps its place too. Seams do not
// tear: a vertex on one collapses only along it, its two sides at once, onto the seam's next vertex; where seams meet
// or end, vertices stay. No triangle turns over in the texture. Vertices on a border collapse along it only, and no
// texture coordinates leave the rectangle that the original's span. Such a mesh is not moved once more.
//
// Vertices where more than two triangles share an edge, or neighbours turn opposite ways, stay where they are.
// Collapses run on one thread, in an order that depends on the mesh alone.
#pragma once

#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

struct DecimateStats {
  std::size_t faces = 0, vertices = 0;
  // From the original's vertices to the nearest point of the result, in the mesh's units.
  double max_distance = 0, rms_distance = 0;
};

// Aims at `faces` triangles: as many, or one fewer where the surface is closed and the number odd; more where nothing
// else can be taken away. Normals are smooth ones, made anew, whatever normals the mesh has. A mesh that has no more
// triangles comes back as it is, with smooth normals where it has none. Positions that no triangle has count nowhere.
// kMalformed where the mesh is too large for single precision (require_traceable) or no triangle has area.
Mesh decimate(const Mesh& mesh, std::size_t faces, DecimateStats* stats = nullptr, const Progress& progress = {});

}  // namespace burnish
