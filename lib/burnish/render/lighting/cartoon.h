// Cartoon-like shading in a few flat tones, and an outline (Tarini et al., section 5.1, number 4).
//
// The brightness I = Σ luminance(colour) · max(0, n·l), at most 1, chooses one of `bands` tones on the way from
// `shadow` to `diffuse`: number min(⌊I · bands⌋, bands − 1). Where n·v is below `outline_cosine`, the surface turns
// away and takes the outline's colour. Ambient light takes no part.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/render/lighting/lighting.h"

namespace burnish {

struct Cartoon {
  Vec3d diffuse{1, 1, 1}, shadow{0.3, 0.3, 0.3}, outline;
  double outline_cosine = 0;  // 0: no outline
  int bands = 3;              // at least 2

  Shaded shade(Vec3d n, const Illumination& in) const {
    if (outline_cosine > 0 && dot(n, in.to_viewer) < outline_cosine - kRounding) return {outline, {}};
    double brightness = 0;
    for (const Arriving& light : in.lights)
      brightness += luminance(light.colour) * std::max(0.0, dot(n, light.direction));
    const double tone = std::min(std::floor(brightness * bands + kRounding), bands - 1.0) / (bands - 1);
    return {shadow + (diffuse - shadow) * tone, {}};
  }
};

}  // namespace burnish
