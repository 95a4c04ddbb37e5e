#include "cli/image_libraries.h"

#include "burnish/core/image_io.h"
#include "burnish/palette/library_versions.h"

namespace burnish::cli {

std::string image_libraries() { return codec_versions() + palette_library_versions() + ", "; }

}  // namespace burnish::cli
