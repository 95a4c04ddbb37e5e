// The texels that a lookup into a texture takes part of, with their weights: one, four of a level, or those of two
// levels.
#pragma once

#include <array>

#include "burnish/core/mip.h"
#include "burnish/render/lookup.h"
#include "burnish/render/mip_level.h"

namespace burnish {

struct TextureTaps {
  struct Tap {
    int level;
    TexelPosition texel;
    double weight;
  };
  std::array<Tap, 8> taps;
  int count = 0;  // weights of the first `count` sum to 1

  const Tap* begin() const { return taps.data(); }
  const Tap* end() const { return taps.data() + count; }
  // The one that counts most.
  const Tap& main() const {
    return *std::max_element(begin(), end(), [](const Tap& a, const Tap& b) { return a.weight < b.weight; });
  }
};

struct TextureLookup {
  Filter filter = Filter::kNearest;
  MipMode mip = MipMode::kOff;
  Addressing addressing;
  int samples = 1;  // n × n a pixel, for the footprint
};

inline TextureTaps texture_taps(const SurfacePoint& p, const TextureLookup& lookup, int width, int height, int levels) {
  TextureTaps out;
  const auto add_level = [&](int level, double share) {
    int w = width, h = height;
    for (int l = 0; l < level; l++) w = next_level_size(w), h = next_level_size(h);
    if (lookup.filter == Filter::kNearest) {
      out.taps[out.count++] = {level, nearest_texel(p.u, p.v, w, h, lookup.addressing), share};
      return;
    }
    const BilinearTaps taps = bilinear_taps(p.u, p.v, w, h, lookup.addressing);
    for (int i = 0; i < 4; i++) out.taps[out.count++] = {level, taps.texel[i], taps.weight[i] * share};
  };
  const double lambda = lookup.mip == MipMode::kOff ? 0 : mip_lambda(p, width, height, lookup.samples, levels);
  const int finer = lookup.mip == MipMode::kLinear ? int(lambda) : nearest_level(lambda);
  const double share = lookup.mip == MipMode::kLinear ? lambda - finer : 0;
  add_level(finer, 1 - share);
  if (share > 0) add_level(finer + 1, share);
  return out;
}

}  // namespace burnish
