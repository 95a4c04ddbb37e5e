// Indexed maps and palettes in PNG. mutate_png.cpp keeps the checksums right.
#include "burnish/palette/indexed_map.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) {
  if (has_own_palette(file)) read_palette(file, GreenAxis::kDown);
  read_indexed_map(file, GreenAxis::kDown);
}

const fuzz::Target target("indexed_png", "map.png", read);

}  // namespace
