// Histograms of normal maps. mutate_histogram.cpp changes what is in their zlib streams.
#include "burnish/palette/files/histogram_file.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_histogram(file); }

const fuzz::Target target("histogram", "maps.histogram", read);

}  // namespace
