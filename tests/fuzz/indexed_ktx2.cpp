// Indexed maps in KTX2, with a palette of their own or without.
#include "burnish/core/error.h"
#include "burnish/palette/indexed_map.h"
#include "small_palette.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) {
  try {
    read_indexed_map(file);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kUsage) throw;
    read_indexed_map(file, GreenAxis::kUp, fuzz::small_palette());
  }
}

const fuzz::Target target("indexed_ktx2", "map.ktx2", read);

}  // namespace
