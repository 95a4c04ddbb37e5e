#include "burnish/mesh/files/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_readers.h"

namespace burnish {
namespace {

std::string bytes_of(const FileRef& file) {
  require_readable(file);
  std::ifstream in(file.path, std::ios::binary);
  std::string bytes;
  for (std::size_t chunk = 1 << 16; in; chunk *= 2) {
    const std::size_t size = bytes.size();
    bytes.resize(size + chunk);
    in.read(bytes.data() + size, std::streamsize(chunk));
    bytes.resize(size + std::size_t(in.gcount()));
  }
  if (in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return bytes;
}

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
  return parse_mesh(type, bytes_of(file), file.name, stats);
}

Mesh parse_mesh(MeshFileType type, std::string_view bytes, const std::string& name, MeshReadStats* stats) {
  PolygonMesh polygons = read_polygons(type, bytes, name);
  MeshReadStats found{.left_out = std::move(polygons.left_out)};
  Mesh mesh = to_triangles(std::move(polygons), name, found.dropped_faces);
  if (stats) *stats = std::move(found);
  return mesh;
}

MeshFileType mesh_file_type_of(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".obj") return MeshFileType::kObj;
  if (extension == ".ply") return MeshFileType::kPly;
  if (extension == ".off") return MeshFileType::kOff;
  if (extension == ".stl") return MeshFileType::kStl;
  throw file_error(ErrorKind::kUnsupported, name,
                   "expected a mesh's name (.obj, .ply, .off, .stl), got '" + extension + "'");
}

}  // namespace burnish
