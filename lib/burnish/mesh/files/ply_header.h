// The header of a PLY file: which elements follow, and what each of them holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "burnish/mesh/files/text_lines.h"

namespace burnish {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

inline bool is_integer(PlyType type) { return type < PlyType::kFloat; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  std::optional<PlyType> count_type;  // of a list; an integer
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The index of the property, if there is one that is a list, or is none.
  std::optional<std::size_t> find(const std::string& property, bool list = false) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;

  const PlyElement* find(const std::string& element) const;
};

// Leaves the lines at "end_header". kMalformed, with the line, for what is no header of PLY 1.0.
PlyHeader read_ply_header(TextLines& lines);

}  // namespace burnish
