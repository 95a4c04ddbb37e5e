// What a file says of its texels beside them, each under a name such as "burnish:space".
//
// EXR holds each as a header attribute of its type, JSON as text. PNG and TIFF hold all of them as members of one JSON
// object in the image description; one number alone is a number there, several are an array. TGA and BMP hold none.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace burnish {

struct JsonText {
  std::string text;  // valid JSON
};

using AttributeValue = std::variant<std::string, std::vector<double>, JsonText>;
// In the order they are written in. "ImageDescription" by itself is the description's own text.
using Attributes = std::vector<std::pair<std::string, AttributeValue>>;

}  // namespace burnish
