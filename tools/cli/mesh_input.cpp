#include "cli/mesh_input.h"

#include "burnish/core/wording.h"

namespace burnish::cli {

void warn_of_dropped_faces(Tool& tool, const std::string& mesh, std::size_t faces) {
  if (faces)
    tool.warn("'" + mesh + "': " + counted(faces, "face") + " without area " + (faces == 1 ? "is" : "are") +
              " left out");
}

Mesh read_mesh(Tool& tool, const FileRef& file, MeshReadStats* stats) {
  MeshReadStats found;
  Mesh mesh = burnish::read_mesh(file, &found);
  warn_of_dropped_faces(tool, file.name, found.dropped_faces);
  if (stats) *stats = found;
  return mesh;
}

void warn_of_overlaps(Tool& tool, const std::string& mesh, std::size_t texels, const std::string& what) {
  if (texels)
    tool.warn("'" + mesh + "': " + counted(texels, "texel") + (texels == 1 ? " is" : " are") +
              " covered by more than one triangle; the first one's " + what + " counts");
}

}  // namespace burnish::cli
