// Indexed maps in DDS, which hold no palette.
#include "burnish/palette/indexed_map.h"
#include "small_palette.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_indexed_map(file, GreenAxis::kUp, fuzz::small_palette()); }

const fuzz::Target target("indexed_dds", "map.dds", read);

}  // namespace
