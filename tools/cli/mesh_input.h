// Meshes that tools read, and what is said of them.
#pragma once

#include <string>

#include "burnish/mesh/files/mesh_io.h"
#include "cli/tool.h"

namespace burnish::cli {

void warn_of_dropped_faces(Tool& tool, const std::string& mesh, std::size_t faces);

// Warns of faces that are left out.
Mesh read_mesh(Tool& tool, const FileRef& file, MeshReadStats* stats = nullptr);

// Where several triangles of a mesh lie on a texel of its map; `what` the map holds of the first of them.
void warn_of_overlaps(Tool& tool, const std::string& mesh, std::size_t texels, const std::string& what);

}  // namespace burnish::cli
