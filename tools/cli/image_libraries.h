// Versions of what is behind the tools that read images, for --version.
#pragma once

#include <string>

namespace burnish::cli {

std::string image_libraries();
// Of tools that read none: named instead, so that they are not linked to those libraries.
inline std::string no_libraries() { return ""; }

}  // namespace burnish::cli
