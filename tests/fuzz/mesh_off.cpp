// Meshes in OFF.
#include "burnish/mesh/files/mesh_io.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_mesh(file); }

const fuzz::Target target("mesh_off", "mesh.off", read);

}  // namespace
