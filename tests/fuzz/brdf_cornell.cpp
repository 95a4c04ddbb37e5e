// Measured reflectance of Cornell's, text.
#include "measured_surface.h"
#include "target.h"

namespace {

using namespace burnish;

const fuzz::Target target("brdf_cornell", "surface.brdf", fuzz::read_measured_surface);

}  // namespace
