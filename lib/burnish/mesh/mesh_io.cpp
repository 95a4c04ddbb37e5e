#include "burnish/mesh/mesh_io.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>

#include "burnish/core/error.h"
#include "burnish/mesh/obj_check.h"
#include "burnish/mesh/polygon.h"

namespace burnish {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  using TexCoord2D = OpenMesh::Vec2d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using Options = OpenMesh::IO::Options;

// While it lives, OpenMesh's chatter is collected instead of printed. One at a time: its streams are global.
class CollectedChatter {
 public:
  CollectedChatter() : lock_(mutex()) {
    omerr().disconnect(std::cerr);
    omerr().connect(text_);
    omout().disable(), omlog().disable();
  }
  ~CollectedChatter() {
    omerr().disconnect(text_);
    omerr().connect(std::cerr);
    omout().enable(), omlog().enable();
  }
  // The first line that tells of something lost; edges of more than two faces are kept on vertices of their own, and
  // materials are not read.
  std::string complaint() const {
    std::istringstream lines(text_.str());
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && line.find("complex") == line.npos && line.find("aterial") == line.npos &&
          line.find("topology") == line.npos)
        return line;
    return {};
  }

 private:
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  std::lock_guard<std::mutex> lock_;
  std::ostringstream text_;
};

std::string extension_of(const std::string& name) {
  std::string ext = std::filesystem::path(name).extension().string();
  std::ranges::transform(ext, ext.begin(), [](unsigned char c) { return std::tolower(c); });
  return ext;
}

constexpr std::size_t kMostCorners = 1000;  // of a face; cutting ears off takes the square

Vec3d to_vec3(const OpenMesh::Vec3d& v) { return {v[0], v[1], v[2]}; }

bool finite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Gives each vertex's corners with equal values one index.
template <typename T>
class SharedValues {
 public:
  explicit SharedValues(std::size_t vertices) : first_(vertices, kNone) {}

  std::uint32_t index(std::size_t vertex, const T& value) {
    std::uint32_t* link = &first_[vertex];
    while (*link != kNone) {
      if (values[*link] == value) return *link;
      link = &next_[*link];
    }
    const std::uint32_t index = *link = std::uint32_t(values.size());
    values.push_back(value);
    next_.push_back(kNone);
    return index;
  }

  std::vector<T> values;

 private:
  static constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> first_, next_;
};

struct Attributes {
  bool vertex_uvs = false, corner_uvs = false, vertex_normals = false, corner_normals = false;
  bool uvs() const { return vertex_uvs || corner_uvs; }
  bool normals() const { return vertex_normals || corner_normals; }
};

Mesh to_mesh(const PolyMesh& in, const Attributes& has, const std::string& name) {
  Mesh mesh;
  mesh.name = name;
  mesh.positions.reserve(in.n_vertices());
  for (const auto v : in.vertices()) mesh.positions.push_back(to_vec3(in.point(v)));
  SharedValues<Vec2d> uvs(in.n_vertices());
  SharedValues<Vec3d> normals(in.n_vertices());
  std::vector<std::uint32_t> position, uv, normal;
  std::vector<Vec3d> outline;
  for (const auto face : in.faces()) {
    position.clear(), uv.clear(), normal.clear(), outline.clear();
    for (const auto corner : in.fh_range(face)) {
      const auto v = in.to_vertex_handle(corner);
      position.push_back(std::uint32_t(v.idx()));
      outline.push_back(mesh.positions[v.idx()]);
      if (has.uvs()) {
        const auto t = has.corner_uvs ? in.texcoord2D(corner) : in.texcoord2D(v);
        uv.push_back(uvs.index(v.idx(), {t[0], t[1]}));
      }
      if (has.normals()) {
        const Vec3d n = to_vec3(has.corner_normals ? in.normal(corner) : in.normal(v));
        normal.push_back(normals.index(v.idx(), n));
      }
    }
    if (outline.size() > kMostCorners)
      throw file_error(ErrorKind::kUnsupported, name,
                       "expected faces of at most " + std::to_string(kMostCorners) + " corners, got one of " +
                           std::to_string(outline.size()));
    for (const Corners& t : triangulate(outline)) {
      mesh.triangles.push_back({position[t[0]], position[t[1]], position[t[2]]});
      if (has.uvs()) mesh.triangle_uvs.push_back({uv[t[0]], uv[t[1]], uv[t[2]]});
      if (has.normals()) mesh.triangle_normals.push_back({normal[t[0]], normal[t[1]], normal[t[2]]});
    }
  }
  mesh.uvs = std::move(uvs.values);
  mesh.normals = std::move(normals.values);
  return mesh;
}

// Normals of no length become those of a triangle that uses them.
void normalise(Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangle_normals.size(); t++)
    for (std::uint32_t i : mesh.triangle_normals[t])
      if (Vec3d& n = mesh.normals[i]; !(length(n) > 1e-9))
        if (const Vec3d p = mesh.perpendicular(t); length(p) > 0) n = p;
  for (Vec3d& n : mesh.normals) n = length(n) > 1e-300 ? normalized(n) : Vec3d{0, 0, 1};
}

void require_finite(const Mesh& mesh) {
  const auto refuse = [&](const char* what) {
    throw file_error(ErrorKind::kMalformed, mesh.name,
                     std::string("expected finite ") + what + ", got NaN or infinity");
  };
  if (!std::ranges::all_of(mesh.positions, finite)) refuse("positions");
  if (!std::ranges::all_of(mesh.normals, finite)) refuse("normals");
  if (!std::ranges::all_of(mesh.uvs, [](Vec2d t) { return std::isfinite(t.x) && std::isfinite(t.y); }))
    refuse("texture coordinates");
}

void write_obj(std::ostream& out, const Mesh& mesh) {
  char line[128];
  const auto put = [&](const char* format, auto... values) {
    out.write(line, std::snprintf(line, sizeof line, format, values...));
  };
  for (const Vec3d& p : mesh.positions) put("v %.9g %.9g %.9g\n", p.x, p.y, p.z);
  for (const Vec2d& t : mesh.uvs) put("vt %.9g %.9g\n", t.x, t.y);
  for (const Vec3d& n : mesh.normals) put("vn %.9g %.9g %.9g\n", n.x, n.y, n.z);
  for (std::size_t t = 0; t < mesh.triangles.size(); t++) {
    out << 'f';
    for (int c = 0; c < 3; c++) {
      put(" %u", mesh.triangles[t][c] + 1);
      if (mesh.has_uvs()) put("/%u", mesh.triangle_uvs[t][c] + 1);
      if (mesh.has_normals()) put(mesh.has_uvs() ? "/%u" : "//%u", mesh.triangle_normals[t][c] + 1);
    }
    out << '\n';
  }
}

void write_by_openmesh(std::ostream& out, const std::string& extension, const Mesh& mesh, const std::string& name) {
  PolyMesh poly;
  for (const Vec3d& p : mesh.positions) poly.add_vertex({p.x, p.y, p.z});
  const CollectedChatter chatter;
  for (const Corners& t : mesh.triangles)
    if (!poly.add_face(poly.vertex_handle(t[0]), poly.vertex_handle(t[1]), poly.vertex_handle(t[2])).is_valid())
      throw file_error(ErrorKind::kUnsupported, name,
                       "a mesh with more than two triangles on an edge is written as OBJ only");
  if (!OpenMesh::IO::write_mesh(poly, out, extension, Options::Default, 9))
    throw file_error(ErrorKind::kIo, name, "cannot be written");
}

}  // namespace

Mesh read_mesh(const FileRef& file, MeshReadStats* stats) {
  const MeshFileType type = mesh_file_type_of(file.name);
  require_readable(file);
  PolyMesh poly;
  poly.request_vertex_normals(), poly.request_halfedge_normals();
  poly.request_vertex_texcoords2D(), poly.request_halfedge_texcoords2D();
  Options options(Options::VertexNormal | Options::VertexTexCoord);
  ObjContents obj;
  if (type == MeshFileType::kObj) {
    obj = check_obj(file);
    options += Options::FaceTexCoord;
  }
  std::string complaint;
  bool read = false;
  {
    const CollectedChatter chatter;
    try {
      read = OpenMesh::IO::read_mesh(poly, file.path, options);
    } catch (const std::exception&) {  // of allocations and streams, on damaged headers
    }
    complaint = chatter.complaint();
  }
  if (!read || !complaint.empty())
    throw file_error(ErrorKind::kMalformed, file.name,
                     "cannot be read as a mesh" + (complaint.empty() ? "" : " (" + complaint + ")"));
  Attributes has;
  if (type == MeshFileType::kObj) {
    has.corner_uvs = obj.uvs, has.corner_normals = obj.normals;
  } else if (type != MeshFileType::kStl) {
    has.vertex_uvs = options.vertex_has_texcoord(), has.vertex_normals = options.vertex_has_normal();
  }
  if (poly.n_faces() == 0) throw file_error(ErrorKind::kMalformed, file.name, "expected a mesh with faces, got none");
  Mesh mesh = to_mesh(poly, has, file.name);
  require_finite(mesh);
  normalise(mesh);
  if (stats) stats->dropped_faces = obj.faces > poly.n_faces() ? obj.faces - poly.n_faces() : 0;
  return mesh;
}

MeshFileType mesh_file_type_of(const std::string& name) {
  const std::string ext = extension_of(name);
  if (ext == ".obj") return MeshFileType::kObj;
  if (ext == ".ply") return MeshFileType::kPly;
  if (ext == ".off") return MeshFileType::kOff;
  if (ext == ".stl") return MeshFileType::kStl;
  throw file_error(ErrorKind::kUnsupported, name, "expected a mesh's name (.obj, .ply, .off, .stl), got '" + ext + "'");
}

void write_mesh(const FileRef& file, MeshFileType type, const Mesh& mesh) {
  if (type != MeshFileType::kObj && mesh.has_uvs())
    throw file_error(ErrorKind::kUnsupported, file.name, "texture coordinates of corners are written as OBJ only");
  std::ofstream out(file.path, std::ios::binary);
  if (type == MeshFileType::kObj) write_obj(out, mesh);
  else write_by_openmesh(out, extension_of(file.name), mesh, file.name);
  if (!out.flush()) throw file_error(ErrorKind::kIo, file.name, "cannot be written");
}

}  // namespace burnish
