// What the reader and the writer of images share of OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "burnish/core/file_type.h"

namespace burnish::detail {

OIIO::TypeDesc to_oiio(SampleType type);
// OpenImageIO's name of what writes a type; empty where nothing does.
const char* codec_of(FileType type);
// What a codec says, on one line.
std::string one_line(std::string text);

}  // namespace burnish::detail
