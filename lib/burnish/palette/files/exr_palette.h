// The palette in the attributes of an EXR.
#pragma once

#include "burnish/core/codecs/exr_file.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

constexpr const char* kIndexChannel = "index";
constexpr int kIndexZipLevel = 2;  // of indices, higher levels save 4 % and cost half as much time again

ExrAttributes palette_attributes(const Palette& palette);
// kMalformed where there is none.
Palette extract_palette(const ExrReader& in, const FileRef& file);

}  // namespace burnish::detail
