// Light lists, .lp.
#include "burnish/ptm/light_list.h"

#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_light_list(file); }

const fuzz::Target target("light_list", "lights.lp", read);

}  // namespace
