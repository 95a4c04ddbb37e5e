#include "cli/mesh_input.h"

#include "burnish/core/counted.h"

namespace burnish::cli {

Mesh read_mesh(Tool& tool, const FileRef& file, MeshReadStats* stats) {
  MeshReadStats found;
  Mesh mesh = burnish::read_mesh(file, &found);
  if (found.dropped_faces)
    tool.warn("'" + file.name + "': " + counted(found.dropped_faces, "face") + " without area " +
              (found.dropped_faces == 1 ? "is" : "are") + " left out");
  if (stats) *stats = found;
  return mesh;
}

void warn_of_overlaps(Tool& tool, const std::string& mesh, std::size_t texels, const std::string& what) {
  if (texels)
    tool.warn("'" + mesh + "': " + counted(texels, "texel") + (texels == 1 ? " is" : " are") +
              " covered by more than one triangle; the first one's " + what + " counts");
}

}  // namespace burnish::cli
