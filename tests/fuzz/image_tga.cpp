// TGA, which is known by its name only.
#include "burnish/core/image_io.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) { read_image(file); }

const fuzz::Target target("image_tga", "image.tga", read);

}  // namespace
