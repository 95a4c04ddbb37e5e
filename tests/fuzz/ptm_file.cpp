// .ptm files in all of their formats.
#include "burnish/ptm/files/ptm_file.h"

#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_ptm(file); }

const fuzz::Target target("ptm_file", "map.ptm", read);

}  // namespace
