// A palette for maps that hold indices only.
#pragma once

#include "burnish/palette/indexed_map.h"
#include "target.h"

namespace burnish::fuzz {

inline const FileRef& small_palette() {
  static const MemoryFile file("palette.exr");
  static const bool written = [] {
    const Palette palette{{{0, 0, 1}, {0.6f, 0, 0.8f}, {0, -0.8f, 0.6f}}, {{1, 0, 2}, {7, 2, 1}}};
    write_palette(file.ref(), FileType::kExr, palette);
    return true;
  }();
  (void)written;
  return file.ref();
}

}  // namespace burnish::fuzz
