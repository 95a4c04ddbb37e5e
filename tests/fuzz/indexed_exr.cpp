// Indexed maps and palettes in EXR.
#include "burnish/palette/indexed_map.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) {
  if (has_own_palette(file)) read_palette(file);
  read_indexed_map(file);
}

const fuzz::Target target("indexed_exr", "map.exr", read);

}  // namespace
