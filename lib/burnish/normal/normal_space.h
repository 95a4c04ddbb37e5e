// Whose axes the vectors of a normal map are along, and how its file says so.
//
// Its attribute burnish:space is "tangent" or "object". TGA and BMP do not tell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"

namespace burnish {

enum class NormalSpace { kTangent, kObject };
const char* name(NormalSpace space);  // "tangent", "object"
// kMalformed, naming the file, for any other text.
NormalSpace space_from_name(const std::string& text, const std::string& file_name);

// For the writer of a normal map.
Attributes space_attributes(NormalSpace space);
// What the file says; none where it says nothing. kMalformed for a space of another name.
std::optional<NormalSpace> recorded_space(const ImageReader& reader);

// What files that belong together say, none where none of them does. kMalformed, naming both, where two contradict each
// other.
struct SpaceOfFile {
  std::string name;
  std::optional<NormalSpace> space;
};
std::optional<NormalSpace> agreed_space(const std::vector<SpaceOfFile>& files);

}  // namespace burnish
