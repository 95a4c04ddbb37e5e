// Attributes as the codecs take them and give them back.
#pragma once

#include <OpenImageIO/imageio.h>

#include <optional>

#include "burnish/core/attributes.h"
#include "burnish/core/file_type.h"

namespace burnish::detail {

void put_attributes(OIIO::ImageSpec& spec, FileType type, const Attributes& attributes);
// None where the file does not say. Of a description that is JSON, members that are no text as they are written there.
std::optional<std::string> text_attribute(const OIIO::ImageSpec& spec, const std::string& name);
// None where the file does not say, or says something that is not numbers.
std::optional<std::vector<double>> number_attribute(const OIIO::ImageSpec& spec, const std::string& name);

}  // namespace burnish::detail
