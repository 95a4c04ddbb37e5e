// The size that maps of one surface share: that of the first.
#pragma once

#include <string>

#include "burnish/core/error.h"

namespace burnish {

struct SharedSize {
  int width = 0, height = 0;  // 0: there was no map yet
  std::string of;             // its name

  // kMalformed, naming both maps, where this one has another.
  void take(int w, int h, const std::string& name) {
    const auto text = [](int x, int y) { return std::to_string(x) + "x" + std::to_string(y); };
    if (width == 0) *this = {w, h, name};
    if (w != width || h != height)
      throw file_error(ErrorKind::kMalformed, name,
                       "expected " + text(width, height) + " texels as in '" + of + "', got " + text(w, h));
  }
};

}  // namespace burnish
