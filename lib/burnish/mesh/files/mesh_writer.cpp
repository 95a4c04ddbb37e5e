// The mesh files that are written, as text, so that every type holds the same nine digits.
#include <cerrno>
#include <charconv>
#include <concepts>
#include <cstring>
#include <fstream>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

// Text whose numbers do not depend on the locale.
class TextWriter {
 public:
  explicit TextWriter(std::ostream& out) : out_(out) {}

  TextWriter& operator<<(std::string_view text) { return out_ << text, *this; }
  TextWriter& operator<<(double value) { return put(value, std::chars_format::general, 9); }
  TextWriter& operator<<(std::unsigned_integral auto value) { return put(value); }
  TextWriter& operator<<(Vec3d v) { return *this << v.x << " " << v.y << " " << v.z; }
  TextWriter& operator<<(Vec2d v) { return *this << v.x << " " << v.y; }

 private:
  template <typename... T>
  TextWriter& put(T... value) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value...);
    out_.write(text, end - text);
    return *this;
  }

  std::ostream& out_;
};

void write_obj(TextWriter& out, const Mesh& mesh) {
  for (const Vec3d& p : mesh.positions) out << "v " << p << "\n";
  for (const Vec2d& t : mesh.uvs) out << "vt " << t << "\n";
  for (const Vec3d& n : mesh.normals) out << "vn " << n << "\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    out << "f";
    for (int c = 0; c < 3; c++) {
      out << " " << mesh.triangles[t][c] + 1;
      if (mesh.has_uvs()) out << "/" << mesh.triangle_uvs[t][c] + 1;
      if (mesh.has_normals()) out << (mesh.has_uvs() ? "/" : "//") << mesh.triangle_normals[t][c] + 1;
    }
    out << "\n";
  }
}

// Its vertices have one normal and texture coordinate each: corners that differ in them become several vertices.
void write_ply(TextWriter& out, const Mesh& mesh) {
  std::vector<Corners> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      corners.push_back({mesh.triangles[t][c], mesh.has_uvs() ? mesh.triangle_uvs[t][c] : 0,
                         mesh.has_normals() ? mesh.triangle_normals[t][c] : 0});
  const std::vector<std::uint32_t> first = weld(corners);
  std::vector<std::size_t> vertex(corners.size());
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < corners.size(); i++) vertex[i] = first[i] == i ? vertices++ : vertex[first[i]];

  out << "ply\nformat ascii 1.0\nelement vertex " << vertices
      << "\nproperty float x\nproperty float y\nproperty float z\n";
  if (mesh.has_normals()) out << "property float nx\nproperty float ny\nproperty float nz\n";
  if (mesh.has_uvs()) out << "property float s\nproperty float t\n";
  out << "element face " << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < corners.size(); i++) {
    if (first[i] != i) continue;
    const auto [position, uv, normal] = corners[i];
    out << mesh.positions[position];
    if (mesh.has_normals()) out << " " << mesh.normals[normal];
    if (mesh.has_uvs()) out << " " << mesh.uvs[uv];
    out << "\n";
  }
  for (std::size_t i = 0; i < corners.size(); i += 3)
    out << "3 " << vertex[i] << " " << vertex[i + 1] << " " << vertex[i + 2] << "\n";
}

void write_off(TextWriter& out, const Mesh& mesh) {
  out << "OFF\n" << mesh.positions.size() << " " << mesh.triangles.size() << " 0\n";
  for (const Vec3d& p : mesh.positions) out << p << "\n";
  for (const Corners& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
}

void write_stl(TextWriter& out, const Mesh& mesh) {
  out << "solid mesh\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    const Vec3d perpendicular = mesh.perpendicular(t);
    out << "facet normal " << (length(perpendicular) > 0 ? normalized(perpendicular) : Vec3d{}) << "\nouter loop\n";
    for (int c = 0; c < 3; c++) out << "vertex " << mesh.position(t, c) << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid mesh\n";
}

}  // namespace

void write_mesh(const FileRef& file, MeshFileType type, const Mesh& mesh) {
  if (mesh.has_uvs() && (type == MeshFileType::kOff || type == MeshFileType::kStl))
    throw file_error(ErrorKind::kUnsupported, file.name, "texture coordinates are written as OBJ or PLY only");
  errno = 0;
  std::ofstream stream(file.path, std::ios::binary);
  TextWriter out(stream);
  if (type == MeshFileType::kObj) write_obj(out, mesh);
  else if (type == MeshFileType::kPly) write_ply(out, mesh);
  else if (type == MeshFileType::kOff) write_off(out, mesh);
  else write_stl(out, mesh);
  if (!stream.flush())
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace burnish
