// MERL's measured reflectance.
#include "measured_surface.h"
#include "target.h"

namespace {

using namespace burnish;

const fuzz::Target target("brdf_merl", "surface.binary", fuzz::read_measured_surface);

}  // namespace
