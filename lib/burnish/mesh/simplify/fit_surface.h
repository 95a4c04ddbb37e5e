// Moves the vertices of a mesh until its surface lies as near as it can to the points of another.
//
// By turns, each point of the other finds its nearest place on the mesh, and the vertices go where the sum of the
// points' squared distances to those places, weighted by area, is least (Hoppe, DeRose, Duchamp, McDonald and Stuetzle,
// "Mesh optimization", 1993, section 4.1).
#pragma once

#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

// Triangles stay as they are, and none turns by 60° or more from where it was. Vertices on edges of more than two
// triangles, or of two that turn opposite ways, keep their places. `mesh` has positions only, whose surface single
// precision can hold (require_traceable). Runs in parallel; sums are added in the points' order.
void fit_surface(Mesh& mesh, const Mesh& to, const Progress& progress = {});

}  // namespace burnish
