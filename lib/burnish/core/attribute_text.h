// Attributes as files hold them, texts and numbers, and back.
#pragma once

#include <optional>

#include "burnish/core/attributes.h"
#include "burnish/core/file_type.h"

namespace burnish::detail {

// What a file of that type is to hold for them: texts and numbers in EXR, one text in PNG and TIFF, nothing in others.
Attributes stored_attributes(FileType type, const Attributes& attributes);

// Of what a file holds: none where it does not say. Of a description that is JSON, members that are no text as they are
// written there.
std::optional<std::string> text_attribute(const Attributes& stored, const std::string& name);
// None where the file does not say, or says something that is not numbers.
std::optional<std::vector<double>> number_attribute(const Attributes& stored, const std::string& name);

}  // namespace burnish::detail
