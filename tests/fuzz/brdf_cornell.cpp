// Measured reflectance of Cornell's, text. Into fewer cells than a tool takes: 700 000 of them would be all the time.
#include "burnish/brdf/measured/readers.h"
#include "burnish/core/whole_file.h"
#include "measured_surface.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) {
  fuzz::ask(*parse_cornell(read_file(file), file.name, {.theta_h = 9, .theta_d = 9, .phi_d = 18}));
}

const fuzz::Target target("brdf_cornell", "surface.brdf", read);

}  // namespace
