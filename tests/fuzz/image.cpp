// Plain images, in whatever their first bytes say: PNG, TIFF, EXR, JPEG, BMP, HDR, PNM. mutate_png.cpp keeps the
// checksums of PNG right.
#include "burnish/core/image_chain.h"
#include "target.h"

namespace {

using namespace burnish;

void read(const FileRef& file) {
  ImageReader reader(file);
  read_image_chain(reader);
}

const fuzz::Target target("image", "image", read);

}  // namespace
