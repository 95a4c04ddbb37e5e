// Auxiliary images: what lies behind a pixel besides its colour, at the pixel's centre. Off the objects,
// numbers are −1 and vectors 0.
//
// normal    shading normal in world space, as the path looks it up (x, y, z)
// position  point in world space (x, y, z)
// uv        texture coordinates, third channel 0
// depth     distance from the camera's plane
// index     into the palette; −1 where the object has no indexed map
// material  id of the texel's interval; −1 where the object has no indexed map
// level     mip level, nearest
#pragma once

#include <string>
#include <vector>

#include "burnish/render/shading_path.h"

namespace burnish {

enum class Aov { kNormal, kPosition, kUv, kDepth, kIndex, kMaterial, kLevel };

const char* name(Aov aov);
// "normal,index": kUsage for names that mean nothing or are given twice.
std::vector<Aov> parse_aovs(const std::string& list);
// 1 or 3.
int channel_count(Aov aov);
// The values of a pixel that shows `point` of an object, or of one that shows none (null); `out` takes
// channel_count().
void write_aov(Aov aov, const FrameSetup& setup, const ShadingPath& path, std::size_t object, const SurfacePoint* point,
               float* out);

}  // namespace burnish
