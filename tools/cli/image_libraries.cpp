#include "cli/image_libraries.h"

#include "burnish/core/image_io.h"
#include "burnish/palette/library_versions.h"

namespace burnish::cli {

Libraries image_libraries() { return {codec_version() + ", " + palette_library_versions() + ", ", set_codec_threads}; }

}  // namespace burnish::cli
