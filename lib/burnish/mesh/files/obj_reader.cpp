#include <algorithm>
#include <array>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_readers.h"
#include "burnish/mesh/files/text_lines.h"

namespace burnish {
namespace {

// Groups, objects and materials: a mesh here has none, and who gave them may miss them.
constexpr std::string_view kLeftOut[] = {"g", "o", "usemtl", "mtllib"};
constexpr std::string_view kPassedOver[] = {
    "s", "l", "p", "mg", "lod", "vp", "bevel", "c_interp", "usemap", "d_interp", "maplib", "shadow_obj", "trace_obj"};
// Free-form curves and surfaces, other files, and what the specification calls superseded.
constexpr std::string_view kUnprovided[] = {"cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",  "parm",
                                            "trim",   "hole", "scrv", "sp",   "end",  "con",   "ctech", "stech",
                                            "call",   "csh",  "fo",   "bsp",  "bzp",  "cdc",   "cdp",   "res"};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name)
      : name_(name), lines_(bytes, name, {.comment = '#', .continued = true}) {}

  PolygonMesh read() {
    while (lines_.next_line()) statement(lines_.word());
    for (std::size_t k = 0; k < 3; k++)
      if (largest_[k].index > count(k))
        throw file_error(ErrorKind::kMalformed, name_,
                         "line " + std::to_string(largest_[k].line) + ": expected " + kWhat[k] + " 1 to " +
                             std::to_string(count(k)) + ", got " + std::to_string(largest_[k].index));
    return std::move(mesh_);
  }

 private:
  // What a corner names, in this order.
  static constexpr const char* kWhat[] = {"vertex", "texture coordinate", "normal"};
  using Named = std::array<bool, 3>;

  void statement(std::string_view keyword) {
    if (keyword == "v") mesh_.positions.push_back(vector());
    else if (keyword == "vn") mesh_.normals.push_back(vector());
    else if (keyword == "vt") texture_coordinate();
    else if (keyword == "f") face();
    else if (std::ranges::count(kUnprovided, keyword))
      throw file_error(ErrorKind::kUnsupported, name_,
                       "line " + std::to_string(lines_.line()) + ": expected polygons only, got " + quoted(keyword));
    else if (std::ranges::count(kLeftOut, keyword)) leave_out(keyword);
    else if (!std::ranges::count(kPassedOver, keyword)) lines_.refuse_word("a statement of OBJ", keyword);
  }

  void leave_out(std::string_view keyword) {
    if (!std::ranges::count(mesh_.left_out, keyword)) mesh_.left_out.emplace_back(keyword);
  }

  // A weight or a colour may follow.
  Vec3d vector() {
    const double x = lines_.number(), y = lines_.number(), z = lines_.number();
    pass_over_numbers();
    return {x, y, z};
  }

  void texture_coordinate() {
    const double u = lines_.number(), v = lines_.has_word() ? lines_.number() : 0;
    pass_over_numbers();
    mesh_.uvs.push_back({u, v});
  }

  void pass_over_numbers() {
    while (lines_.has_word()) lines_.number();
  }

  void face() {
    const std::size_t begin = mesh_.corners.size();
    Named of_face{};
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
      const Named named = corner(word);
      if (mesh_.corners.size() == begin + 1) of_face = named;
      for (std::size_t k = 1; k < 3; k++)
        if (named[k] != of_face[k])
          lines_.refuse_word(std::string("every corner of a face to name its ") + kWhat[k] + " or none to", word);
    }
    const std::size_t corners = mesh_.corners.size() - begin;
    if (corners < 3) lines_.refuse("at least 3 corners of a face", std::to_string(corners));
    if (begin == 0) mesh_.has_uvs = of_face[1], mesh_.has_normals = of_face[2];
    for (std::size_t k = 1; k < 3; k++)
      if (of_face[k] != (k == 1 ? mesh_.has_uvs : mesh_.has_normals))
        throw file_error(ErrorKind::kMalformed, name_,
                         "line " + std::to_string(lines_.line()) + ": expected every face to name its " + kWhat[k] +
                             "s or none to, as the first does, got " +
                             (of_face[k] ? "one that does" : "one that does not"));
    mesh_.end_face();
  }

  // v, v/vt, v//vn or v/vt/vn
  Named corner(std::string_view word) {
    Named named{};
    std::array<std::uint32_t, 3> index{};
    std::string_view rest = word;
    for (std::size_t k = 0;; k++) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      if (slash > 0) named[k] = true, index[k] = resolve(k, rest.substr(0, slash), word);
      if (slash == rest.size()) break;
      rest.remove_prefix(slash + 1);
      if (k == 2) refuse_corner(word);
    }
    if (!named[0]) refuse_corner(word);
    mesh_.corners.push_back({index[0], index[1], index[2]});
    return named;
  }

  // From 1, or from −1 backwards; the file may define later what it names.
  std::uint32_t resolve(std::size_t k, std::string_view text, std::string_view word) {
    long long index = number_in<long long>(text).value_or(0);
    if (index == 0) refuse_corner(word);
    if (index < 0) index += (long long)(count(k)) + 1;
    if (index < 1) refuse_corner(word);
    if (std::size_t(index) > largest_[k].index) largest_[k] = {std::size_t(index), lines_.line()};
    return std::uint32_t(index - 1);
  }

  [[noreturn]] void refuse_corner(std::string_view word) const {
    lines_.refuse_word("a corner as v, v/vt, v//vn or v/vt/vn", word);
  }

  std::size_t count(std::size_t k) const {
    return k == 0 ? mesh_.positions.size() : k == 1 ? mesh_.uvs.size() : mesh_.normals.size();
  }

  const std::string& name_;
  TextLines lines_;
  PolygonMesh mesh_;
  struct {
    std::size_t index = 0, line = 0;
  } largest_[3];
};

}  // namespace

PolygonMesh read_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace burnish
