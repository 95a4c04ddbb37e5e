// Where the heights of a displacement map stand: in which channel, and at which texel beyond the map's edges.
#pragma once

#include <string>

#include "burnish/core/image_io.h"
#include "burnish/normal/height_map.h"

namespace burnish {

// By name, whatever the case, or by number from 0; the first where `wanted` is empty. kMalformed where the file has
// none such.
int height_channel(const ImageReader& reader, const std::string& wanted);

// Which row or column stands at i, for i outside [0, n) too; −1: none.
int wrapped_texel(int i, int n, Wrap wrap);

}  // namespace burnish
