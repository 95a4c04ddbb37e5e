// What a lookup into textures gives: stored samples, which can be filtered, and what those of materials stand for.
#pragma once

#include <array>

#include "burnish/material/material_textures.h"
#include "burnish/render/texture_taps.h"

namespace burnish {

template <std::size_t N>
struct StoredSample {
  std::array<float, N> stored{};

  friend StoredSample operator*(StoredSample s, float w) {
    for (float& v : s.stored) v *= w;
    return s;
  }
  StoredSample& operator+=(const StoredSample& s) {
    for (std::size_t i = 0; i < N; i++) stored[i] += s.stored[i];
    return *this;
  }
};

using MaterialSample = StoredSample<12>;  // t, b, n with an alpha each (0 where there is none)

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
