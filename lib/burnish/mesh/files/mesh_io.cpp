#include "burnish/mesh/files/mesh_io.h"

#include "burnish/core/error.h"
#include "burnish/core/lower_case.h"
#include "burnish/core/whole_file.h"
#include "burnish/mesh/files/mesh_readers.h"

namespace burnish {
namespace {

constexpr std::size_t kMostBytes = std::size_t(1) << 40;  // memory ends before

PolygonMesh read_polygons(MeshFileType type, std::string_view bytes, const std::string& name) {
  switch (type) {
    case MeshFileType::kObj:
      return read_obj(bytes, name);
    case MeshFileType::kPly:
      return read_ply(bytes, name);
    case MeshFileType::kOff:
      return read_off(bytes, name);
    default:
      return read_stl(bytes, name);
  }
}

}  // namespace

Mesh read_mesh(const FileRef& file, MeshReadStats* stats) {
  const MeshFileType type = mesh_file_type_of(file.name);  // before the file is opened
  return parse_mesh(type, read_file(file, kMostBytes), file.name, stats);
}

Mesh parse_mesh(MeshFileType type, std::string_view bytes, const std::string& name, MeshReadStats* stats) {
  PolygonMesh polygons = read_polygons(type, bytes, name);
  MeshReadStats found{.left_out = std::move(polygons.left_out)};
  Mesh mesh = to_triangles(std::move(polygons), name, found.dropped_faces);
  if (stats) *stats = std::move(found);
  return mesh;
}

MeshFileType mesh_file_type_of(const std::string& name) {
  const std::string extension = lower_case_extension(name);
  if (extension == ".obj") return MeshFileType::kObj;
  if (extension == ".ply") return MeshFileType::kPly;
  if (extension == ".off") return MeshFileType::kOff;
  if (extension == ".stl") return MeshFileType::kStl;
  throw file_error(ErrorKind::kUnsupported, name,
                   "expected a mesh's name (.obj, .ply, .off, .stl), got '" + extension + "'");
}

}  // namespace burnish
