#include "burnish/mesh/files/ply_header.h"

#include <algorithm>
#include <set>

namespace burnish {
namespace {

PlyType parse_type(std::string_view word, const TextLines& lines) {
  struct Name {
    std::string_view name, sized_name;
  };
  static constexpr Name kNames[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                                    {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  const auto is = [&](const Name& n) { return n.name == word || n.sized_name == word; };
  const auto* found = std::ranges::find_if(kNames, is);
  if (found == std::end(kNames)) lines.refuse_word("a type of PLY", word);
  return PlyType(found - kNames);
}

std::string parse_name(TextLines& lines) {
  const std::string_view word = lines.word();
  if (word.empty()) lines.refuse_word("a name", word);
  return std::string(word);
}

PlyFormat parse_format(TextLines& lines) {
  static constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::string_view word = lines.word();
  const auto* found = std::ranges::find(kNames, word);
  if (found == std::end(kNames)) lines.refuse_word("ascii, binary_little_endian or binary_big_endian", word);
  if (const std::string_view version = lines.word(); version != "1.0") lines.refuse_word("version 1.0", version);
  return PlyFormat(found - kNames);
}

PlyProperty parse_property(TextLines& lines) {
  PlyProperty p;
  std::string_view word = lines.word();
  if (word == "list") {
    p.count_type = parse_type(lines.word(), lines);
    if (!is_integer(*p.count_type)) lines.refuse("an integer type of a list's length", "a floating one");
    word = lines.word();
  }
  p.type = parse_type(word, lines);
  p.name = parse_name(lines);
  return p;
}

}  // namespace

std::optional<std::size_t> PlyElement::find(const std::string& property, bool list) const {
  for (std::size_t i = 0; i < properties.size(); i++)
    if (properties[i].name == property && properties[i].count_type.has_value() == list) return i;
  return {};
}

const PlyElement* PlyHeader::find(const std::string& element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(TextLines& lines) {
  PlyHeader header;
  std::optional<PlyFormat> format;
  std::set<std::string> elements, properties;  // their names, the latter of the last element
  lines.require_line("'ply'");
  if (const std::string_view word = lines.word(); word != "ply") lines.refuse_word("'ply'", word);
  lines.require_line_end();
  for (;;) {
    lines.require_line("'end_header'");
    const std::string_view keyword = lines.word();
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") break;
    if (keyword == "format") {
      if (format) lines.refuse("one format", "another");
      format = parse_format(lines);
    } else if (keyword == "element") {
      PlyElement e{parse_name(lines), lines.integer<std::uint64_t>("the number of elements"), {}};
      if (!elements.insert(e.name).second) lines.refuse("each element once", "another " + quoted(e.name));
      properties.clear();
      header.elements.push_back(std::move(e));
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.refuse("an element before its properties", "a property");
      PlyProperty p = parse_property(lines);
      if (!properties.insert(p.name).second) lines.refuse("each property once", "another " + quoted(p.name));
      header.elements.back().properties.push_back(std::move(p));
    } else {
      lines.refuse_word("a statement of PLY's header", keyword);
    }
    lines.require_line_end();
  }
  lines.require_line_end();
  if (!format) lines.refuse("a format before 'end_header'", "none");
  header.format = *format;
  return header;
}

}  // namespace burnish
