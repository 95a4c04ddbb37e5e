// What is behind the tools that read images: OpenImageIO, which takes a quarter of a second to load, and what palettes
// need.
#pragma once

#include <string>

namespace burnish::cli {

struct Libraries {
  std::string versions;                  // for --version
  void (*limit_threads)(int) = nullptr;  // 0: as many as there are
};

Libraries image_libraries();
// Of tools that read none: named instead, so that they are not linked to OpenImageIO.
inline Libraries no_libraries() { return {}; }

}  // namespace burnish::cli
