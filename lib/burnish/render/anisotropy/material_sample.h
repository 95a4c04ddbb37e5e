// What a lookup into material textures gives: stored samples, which can be filtered, and what they stand for.
#pragma once

#include <array>

#include "burnish/material/material_textures.h"
#include "burnish/render/anisotropy/texture_taps.h"

namespace burnish {

struct MaterialSample {
  std::array<float, 12> stored{};  // t, b, n with an alpha each (0 where there is none)

  friend MaterialSample operator*(MaterialSample s, float w) {
    for (float& v : s.stored) v *= w;
    return s;
  }
  MaterialSample& operator+=(const MaterialSample& s) {
    for (std::size_t i = 0; i < stored.size(); i++) stored[i] += s.stored[i];
    return *this;
  }
};

inline MaterialSample material_sample(const MaterialTextures& textures, const TextureTaps::Tap& tap) {
  MaterialSample out;
  float* to = out.stored.data();
  for (const MaterialTexture* texture : {&textures.t, &textures.b, &textures.n}) {
    const Image& level = texture->levels[tap.level];
    std::copy_n(level.at(tap.texel.x, tap.texel.y), std::min(4, level.channels), to);
    to += 4;
  }
  return out;
}

// One texture's share of a sample: its true values.
struct MaterialVector {
  Vec3f vector;
  float alpha;
};
inline MaterialVector true_value(const MaterialTexture& texture, const float* stored) {
  const auto channel = [&](int c) { return stored[c] * texture.scale[c] + texture.bias[c]; };
  return {{channel(0), channel(1), channel(2)}, channel(3)};
}

}  // namespace burnish
