// What a codec says of a file, as one of our messages shows it.
#pragma once

#include <string>

#include "burnish/core/file_ref.h"

namespace burnish {

// The first line, since the layers of a codec repeat each other line by line, with the name that people know in place
// of the path: a codec has never heard of standard input. Empty where it says nothing.
std::string codec_message(const std::string& text, const FileRef& file);

}  // namespace burnish
