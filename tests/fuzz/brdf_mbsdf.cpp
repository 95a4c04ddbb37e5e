// NVIDIA's measured reflectance.
#include "measured_surface.h"
#include "target.h"

namespace {

using namespace burnish;

const fuzz::Target target("brdf_mbsdf", "surface.mbsdf", fuzz::read_measured_surface);

}  // namespace
