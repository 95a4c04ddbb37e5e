// What an indexed PNG says of its normals: PLTE holds them to 8 bits, the text chunk `burnish` exactly.
#pragma once

#include <string>

#include "burnish/core/codecs/png_file.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

// Our chunk; null where there is none.
const std::string* metadata_of(const PngForm& form);
PngText metadata_text(const Palette& palette);
// What our chunk says. kMalformed
Palette palette_from_metadata(const std::string& text, const FileRef& file);

inline PngColour to_colour(const Vec3f& normal) {
  const auto byte = [](float v) { return std::uint8_t((0.5f * v + 0.5f) * 255.f + 0.5f); };
  return {byte(normal.x), byte(normal.y), byte(normal.z)};
}

}  // namespace burnish::detail
