#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_readers.h"
#include "burnish/mesh/files/ply_rows.h"

namespace burnish {
namespace {

// Where the values of a vertex stand; those from kNormal and kUv on may be missing.
enum Slot { kPosition = 0, kNormal = 3, kUv = 6, kSlots = 8 };
using Slots = std::array<std::optional<std::size_t>, kSlots>;

Slots vertex_slots(const PlyElement& vertex, const std::string& name) {
  const auto refuse = [&](const std::string& expected, const std::string& got) {
    throw file_error(ErrorKind::kMalformed, name, "expected " + expected + " of element 'vertex', got " + got);
  };
  Slots slots;
  constexpr const char* kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < kUv; i++) {
    slots[i] = vertex.find(kNames[i]);
    if (!slots[i] && i < kNormal) refuse(std::string("property '") + kNames[i] + "'", "none");
    if (i > kNormal && slots[i].has_value() != slots[kNormal].has_value())
      refuse("properties nx, ny and nz or none", "some of them");
  }
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")})
    if (const auto a = vertex.find(u), b = vertex.find(v); a && b && !slots[kUv]) slots[kUv] = a, slots[kUv + 1] = b;
  return slots;
}

template <typename Rows>
class PlyBody {
 public:
  PlyBody(const PlyHeader& header, Rows rows, const std::string& name) : header_(header), rows_(rows), name_(name) {}

  PolygonMesh read() {
    if (const PlyElement* vertex = header_.find("vertex")) vertices_ = vertex->count;
    const PlyElement* face = header_.find("face");
    corner_uvs_ = face && face->find("texcoord", true);
    for (const PlyElement& e : header_.elements)
      if (e.name == "vertex") read_vertices(e);
      else if (e.name == "face") read_faces(e);
      else if (e.name == "tristrips")
        throw file_error(ErrorKind::kUnsupported, name_, "expected faces, got triangle strips");
      else skip_rows(e);
    rows_.end_of_file();
    return std::move(mesh_);
  }

 private:
  void read_vertices(const PlyElement& e) {
    const Slots slots = vertex_slots(e, name_);
    mesh_.has_normals = slots[kNormal].has_value();
    mesh_.has_uvs = corner_uvs_ || slots[kUv];
    std::array<double, kSlots> value{};
    std::vector<std::size_t> slot_of(e.properties.size(), kSlots);
    for (std::size_t s = 0; s < kSlots; s++)
      if (slots[s]) slot_of[*slots[s]] = s;
    for (std::uint64_t i = 0; i < e.count; i++) {
      rows_.begin(e.name, i, e.count);
      for (std::size_t p = 0; p < slot_of.size(); p++)
        if (slot_of[p] < kSlots) value[slot_of[p]] = rows_.number(e.properties[p].type);
        else skip(e.properties[p]);
      rows_.end();
      mesh_.positions.push_back({value[0], value[1], value[2]});
      if (mesh_.has_normals) mesh_.normals.push_back({value[kNormal], value[kNormal + 1], value[kNormal + 2]});
      if (slots[kUv] && !corner_uvs_) mesh_.uvs.push_back({value[kUv], value[kUv + 1]});
    }
  }

  void read_faces(const PlyElement& e) {
    std::optional<std::size_t> indices = e.find("vertex_indices", true);
    if (!indices) indices = e.find("vertex_index", true);
    if (!indices || !is_integer(e.properties[*indices].type))
      throw file_error(ErrorKind::kMalformed, name_,
                       "expected a list 'vertex_indices' of integers of element 'face', got none");
    const std::optional<std::size_t> uvs = e.find("texcoord", true);
    for (std::uint64_t i = 0; i < e.count; i++) {
      rows_.begin(e.name, i, e.count);
      const std::size_t first = mesh_.corners.size(), first_uv = mesh_.uvs.size();
      for (std::size_t p = 0; p < e.properties.size(); p++)
        if (p == *indices) read_corners(e.properties[p]);
        else if (p == uvs) read_corner_uvs(e.properties[p]);
        else skip(e.properties[p]);
      rows_.end();
      const std::size_t corners = mesh_.corners.size() - first, corner_uvs = mesh_.uvs.size() - first_uv;
      if (corners < 3) rows_.refuse("at least 3 corners", std::to_string(corners));
      if (uvs && corner_uvs != corners)
        rows_.refuse(std::to_string(2 * corners) + " texture coordinates", std::to_string(2 * corner_uvs));
      if (uvs)
        for (std::size_t c = 0; c < corners; c++) mesh_.corners[first + c].uv = std::uint32_t(first_uv + c);
      mesh_.end_face();
    }
  }

  void read_corners(const PlyProperty& p) {
    for (std::uint64_t left = length(p); left > 0; left--) {
      const std::int64_t vertex = rows_.integer(p.type);
      if (vertex < 0 || std::uint64_t(vertex) >= vertices_)
        rows_.refuse("one of " + std::to_string(vertices_) + " vertices, from 0", std::to_string(vertex));
      mesh_.add_vertex_corner(std::uint32_t(vertex));
    }
  }

  void read_corner_uvs(const PlyProperty& p) {
    const std::uint64_t numbers = length(p);
    if (numbers % 2) rows_.refuse("two texture coordinates for each corner", std::to_string(numbers) + " numbers");
    for (std::uint64_t i = 0; i < numbers / 2; i++) {
      const double u = rows_.number(p.type), v = rows_.number(p.type);
      mesh_.uvs.push_back({u, v});
    }
  }

  std::uint64_t length(const PlyProperty& list) {
    const std::int64_t length = rows_.integer(*list.count_type);
    if (length < 0) rows_.refuse("the length of a list", std::to_string(length));
    return std::uint64_t(length);
  }

  void skip(const PlyProperty& p) { rows_.skip(p.count_type ? length(p) : 1, p.type); }

  void skip_rows(const PlyElement& e) {
    for (std::uint64_t i = 0; i < e.count && !e.properties.empty(); i++) {
      rows_.begin(e.name, i, e.count);
      for (const PlyProperty& p : e.properties) skip(p);
      rows_.end();
    }
  }

  const PlyHeader& header_;
  Rows rows_;
  const std::string& name_;
  std::uint64_t vertices_ = 0;
  bool corner_uvs_ = false;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh read_ply(std::string_view bytes, const std::string& name) {
  TextLines lines(bytes, name, {});
  const PlyHeader header = read_ply_header(lines);
  const auto read = [&](auto rows) { return PlyBody(header, rows, name).read(); };
  if (header.format == PlyFormat::kAscii) return read(PlyTextRows(lines));
  const std::string_view data = lines.rest_of_file();
  if (header.format == PlyFormat::kBinaryBigEndian) return read(PlyBinaryRows<std::endian::big>(data, name));
  return read(PlyBinaryRows<std::endian::little>(data, name));
}

}  // namespace burnish
