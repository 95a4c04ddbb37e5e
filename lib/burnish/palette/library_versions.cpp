#include "burnish/palette/library_versions.h"

#include <ImfVersion.h>
#include <OpenEXRConfig.h>
#include <png.h>
#include <zlib.h>

#ifdef BURNISH_WITH_IMAGEQUANT
#include <libimagequant.h>
#endif

namespace burnish {

std::string palette_library_versions() {
  std::string text = "OpenEXR " OPENEXR_VERSION_STRING ", libpng " + std::string(png_get_libpng_ver(nullptr)) +
                     ", zlib " + zlibVersion();
#ifdef BURNISH_WITH_IMAGEQUANT
  const int v = liq_version();
  text += ", libimagequant " + std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." +
          std::to_string(v % 100);
#endif
  return text;
}

}  // namespace burnish
