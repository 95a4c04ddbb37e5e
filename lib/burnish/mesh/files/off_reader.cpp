#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_readers.h"
#include "burnish/mesh/files/text_lines.h"

namespace burnish {
namespace {

struct OffHeader {
  bool normals = false, colours = false, uvs = false;
  std::uint32_t vertices = 0, faces = 0;
};

// [ST][C][N][4][n]OFF
OffHeader parse_keyword(std::string_view keyword, const TextLines& lines, const std::string& name) {
  OffHeader header;
  bool dimensions = false;
  std::string_view prefix = keyword;
  const auto take = [&](std::string_view what) {
    const bool there = prefix.starts_with(what);
    if (there) prefix.remove_prefix(what.size());
    return there;
  };
  while (prefix != "OFF") {
    if (take("ST")) header.uvs = true;
    else if (take("C")) header.colours = true;
    else if (take("N")) header.normals = true;
    else if (take("4") || take("n")) dimensions = true;
    else lines.refuse_word("'OFF'", keyword);
  }
  if (dimensions)
    throw file_error(ErrorKind::kUnsupported, name, "expected OFF in three dimensions, got " + quoted(keyword));
  return header;
}

// The keyword, and the numbers of vertices, faces and edges on its line or the next.
OffHeader read_header(TextLines& lines, const std::string& name) {
  lines.require_line("'OFF'");
  OffHeader header = parse_keyword(lines.word(), lines, name);
  if (lines.words_left() == 1) {
    if (const std::string_view word = lines.word(); word != "BINARY") lines.refuse_word("the end of the line", word);
    throw file_error(ErrorKind::kUnsupported, name, "expected OFF as text, got a binary file");
  }
  if (!lines.has_word()) lines.require_line("the numbers of vertices, faces and edges");
  header.vertices = lines.integer<std::uint32_t>("the number of vertices");
  header.faces = lines.integer<std::uint32_t>("the number of faces");
  lines.integer<std::uint32_t>("the number of edges");
  lines.require_line_end();
  return header;
}

void next_of(TextLines& lines, const char* what, std::size_t i, std::size_t count) {
  if (!lines.next_line())
    lines.refuse(std::string(what) + " " + std::to_string(i + 1) + " of " + std::to_string(count),
                 "the end of the file");
}

// Position, normal, colour, texture coordinates, in this order.
void read_vertex(TextLines& lines, const OffHeader& header, PolygonMesh& mesh) {
  const std::size_t numbers = 3 + (header.normals ? 3 : 0) + (header.uvs ? 2 : 0), words = lines.words_left();
  const std::size_t colours = header.colours && words == numbers + 3 ? 3 : header.colours ? 4 : 0;
  if (words != numbers + colours)
    lines.refuse(std::to_string(numbers + colours) + " numbers of a vertex", std::to_string(words));
  const auto vector = [&] {
    const double x = lines.number(), y = lines.number(), z = lines.number();
    return Vec3d{x, y, z};
  };
  mesh.positions.push_back(vector());
  if (header.normals) mesh.normals.push_back(vector());
  for (std::size_t i = 0; i < colours; i++) lines.number();
  if (header.uvs) {
    const double u = lines.number(), v = lines.number();
    mesh.uvs.push_back({u, v});
  }
}

// The number of corners, their vertices, and a colour of up to four numbers.
void read_face(TextLines& lines, const OffHeader& header, PolygonMesh& mesh) {
  const auto corners = lines.integer<std::uint32_t>("the number of a face's corners");
  if (corners == 0) lines.refuse("a face with corners", "none");
  for (std::uint32_t i = 0; i < corners; i++) {
    const auto vertex = lines.integer<std::uint32_t>("the vertex of a corner");
    if (vertex >= header.vertices)
      lines.refuse("vertex 0 to " + std::to_string(std::int64_t(header.vertices) - 1), std::to_string(vertex));
    mesh.add_vertex_corner(vertex);
  }
  for (int i = 0; i < 4 && lines.has_word(); i++) lines.number();
  lines.require_line_end();
  mesh.end_face();
}

}  // namespace

PolygonMesh read_off(std::string_view bytes, const std::string& name) {
  TextLines lines(bytes, name, {.comment = '#'});
  const OffHeader header = read_header(lines, name);
  PolygonMesh mesh;
  mesh.has_uvs = header.uvs, mesh.has_normals = header.normals;
  for (std::uint32_t i = 0; i < header.vertices; i++) {
    next_of(lines, "vertex", i, header.vertices);
    read_vertex(lines, header, mesh);
  }
  for (std::uint32_t i = 0; i < header.faces; i++) {
    next_of(lines, "face", i, header.faces);
    read_face(lines, header, mesh);
  }
  if (lines.next_line()) lines.refuse_word("the end of the file", lines.word());
  return mesh;
}

}  // namespace burnish
