// Scenes in TOML, without the files that they name.
#include "burnish/render/scene.h"

#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_scene(file); }

const fuzz::Target target("scene", "scene.toml", read);

}  // namespace
