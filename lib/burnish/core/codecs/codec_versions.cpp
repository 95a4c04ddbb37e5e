#include <OpenEXRConfig.h>
#include <png.h>
#include <zlib.h>

#include "burnish/core/image_io.h"

namespace burnish {

std::string codec_versions() {
  return "OpenImageIO " BURNISH_OPENIMAGEIO_VERSION ", OpenEXR " OPENEXR_VERSION_STRING ", libpng " +
         std::string(png_get_libpng_ver(nullptr)) + ", zlib " + zlibVersion();
}

}  // namespace burnish
