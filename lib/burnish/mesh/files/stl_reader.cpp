#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_readers.h"
#include "burnish/mesh/files/text_lines.h"
#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;  // the header ends with the number of facets

// The keyword in lower case; the word in either.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, {}, [](unsigned char c) { return std::tolower(c); });
}

// solid facet normal i j k outer loop vertex x y z (three times) endloop endfacet … endsolid
// A name may follow the first and the last.
class AsciiStl {
 public:
  AsciiStl(std::string_view bytes, const std::string& name) : lines_(bytes, name, {}) {}

  std::vector<Vec3d> read() {
    lines_.require_line("'solid'");
    do {
      expect("solid");
      lines_.require_line("'facet' or 'endsolid'");
      std::string_view keyword = word();
      for (; is_keyword(keyword, "facet"); keyword = word()) facet();
      if (!is_keyword(keyword, "endsolid")) refuse("'facet' or 'endsolid'", keyword);
    } while (lines_.next_line());
    return std::move(corners_);
  }

 private:
  void facet() {
    expect("normal");
    double ignored = 0;  // of facets without area often NaN
    for (int i = 0; i < 3; i++)
      if (const std::string_view w = word(); !parse_number(w, ignored)) refuse("a number", w);
    expect("outer"), expect("loop");
    for (int i = 0; i < 3; i++) {
      expect("vertex");
      const double x = number(), y = number(), z = number();
      corners_.push_back({x, y, z});
    }
    expect("endloop"), expect("endfacet");
  }

  // Of this line or one that follows; empty at the file's end.
  std::string_view word() {
    const std::string_view of_line = lines_.word();
    return of_line.empty() && lines_.next_line() ? lines_.word() : of_line;
  }

  void expect(std::string_view keyword) {
    if (const std::string_view w = word(); !is_keyword(w, keyword)) refuse(quoted(keyword), w);
  }

  double number() {
    double value = 0;
    const std::string_view w = word();
    if (!parse_number(w, value) || !in_range(value)) refuse(kInRange, w);
    return value;
  }

  [[noreturn]] void refuse(const std::string& expected, std::string_view got) const {
    lines_.refuse(expected, got.empty() ? "the end of the file" : quoted(got));
  }

  TextLines lines_;
  std::vector<Vec3d> corners_;
};

std::uint32_t u32_at(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; i--) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// A facet is twelve numbers, normal and corners, and two bytes for what programs please.
std::vector<Vec3d> read_binary(std::string_view bytes, std::size_t facets, const std::string& name) {
  std::vector<Vec3d> corners;
  corners.reserve(3 * facets);
  for (std::size_t i = 0; i < 3 * facets; i++) {
    const char* at = bytes.data() + kHeaderBytes + i / 3 * kFacetBytes + 12 + i % 3 * 12;
    const auto number = [&](int k) {
      const double value = std::bit_cast<float>(u32_at(at + 4 * k));
      if (!in_range(value))
        throw file_error(ErrorKind::kMalformed, name,
                         "facet " + std::to_string(i / 3 + 1) + ": expected a finite number, got NaN or infinity");
      return value;
    };
    corners.push_back({number(0), number(1), number(2)});
  }
  return corners;
}

// Binary files may begin with "solid" too: what tells is their size, and where that is wrong, a zero byte.
std::vector<Vec3d> read_corners(std::string_view bytes, const std::string& name) {
  const bool whole_header = bytes.size() >= kHeaderBytes;
  const std::uint64_t facets = whole_header ? u32_at(bytes.data() + kHeaderBytes - 4) : 0;
  const std::uint64_t size = kHeaderBytes + facets * kFacetBytes;
  if (whole_header && bytes.size() == size) return read_binary(bytes, facets, name);
  const std::string_view head = bytes.substr(0, kHeaderBytes);
  const std::size_t first = head.find_first_not_of("\xEF\xBB\xBF \t\r\n");  // a byte order mark
  const bool solid = first != head.npos && is_keyword(head.substr(first, 5), "solid");
  if (solid && head.find('\0') == head.npos) return AsciiStl(bytes, name).read();
  if (!whole_header)
    throw file_error(
        ErrorKind::kMalformed, name,
        "expected 'solid' or the 84 bytes of a binary STL's header, got " + std::to_string(bytes.size()) + " bytes");
  throw file_error(ErrorKind::kMalformed, name,
                   "expected 'solid' or a binary STL of " + std::to_string(size) + " bytes, by its " +
                       std::to_string(facets) + " facets, got " + std::to_string(bytes.size()) + " bytes");
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes, const std::string& name) {
  const std::vector<Vec3d> corners = read_corners(bytes, name);
  PolygonMesh mesh;
  const std::vector<std::uint32_t> first = weld(corners);
  std::vector<std::uint32_t> vertex(corners.size());
  for (std::size_t i = 0; i < corners.size(); i++) {
    if (first[i] == i) {
      vertex[i] = std::uint32_t(mesh.positions.size());
      mesh.positions.push_back(corners[i]);
    }
    mesh.add_vertex_corner(vertex[first[i]]);
    if (i % 3 == 2) mesh.end_face();
  }
  return mesh;
}

}  // namespace burnish
