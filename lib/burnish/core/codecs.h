// What the reader and the writer of images share of OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include "burnish/core/file_type.h"

namespace burnish::detail {

OIIO::TypeDesc to_oiio(SampleType type);
// OpenImageIO's name of what writes a type; empty where nothing does.
const char* codec_of(FileType type);

}  // namespace burnish::detail
