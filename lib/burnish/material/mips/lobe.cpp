#include "burnish/material/mips/lobe.h"

#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr double kLeastAlpha = 1e-6;  // the peak of ward's lobe is 10¹¹ then; floats have room for squares of it

void put(MaterialTexture& texture, int level, int x, int y, Vec3d v, double alpha = 0) {
  float* to = texture.levels[level].at(x, y);
  const double values[4] = {v.x, v.y, v.z, alpha};
  for (int c = 0; c < texture.channels(); c++) to[c] = float((values[c] - texture.bias[c]) / texture.scale[c]);
}

// What ward's fourth channel of n is for k_s = 1.
double ward_factor(const Lobe& o) { return 1 / (4 * kPi * o.alpha_x * o.alpha_y); }

}  // namespace

Lobe lobe_at(const MaterialTextures& textures, int level, int x, int y) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::kMalformed,
                "column " + std::to_string(x) + ", row " + std::to_string(textures.first_row + y) + ": " + what);
  };
  const Vec3d t(textures.t.vector(level, x, y)), b(textures.b.vector(level, x, y)), n(textures.n.vector(level, x, y));
  const std::optional<LocalFrame> frame = orthonormal_frame(n, t);
  if (!frame || !(length(b) > 0)) fail("expected t, b and n of some length, t not along n");
  Lobe o;
  o.frame = *frame;
  if (textures.model == MaterialModel::kBanks) {
    o.k_s = textures.t.alpha(level, x, y);
  } else {
    o.alpha_x = 1 / length(t);
    o.alpha_y = 1 / length(b);
    if (textures.model == MaterialModel::kWard) {
      o.k_s = textures.n.alpha(level, x, y) / ward_factor(o);
    } else {
      o.k_s = textures.t.alpha(level, x, y);
      o.exponent = textures.b.alpha(level, x, y);
    }
  }
  if (!(o.alpha_x >= kLeastAlpha && o.alpha_y >= kLeastAlpha)) fail("expected alphas of at least 1e-6");
  if (!(o.k_s >= 0 && o.exponent >= 0)) fail("expected k_s and N of at least 0");
  return o;
}

void put_lobe(const Lobe& o, MaterialTextures& textures, int level, int x, int y) {
  const bool ward = textures.model == MaterialModel::kWard;
  put(textures.t, level, x, y, o.frame.t / o.alpha_x, o.k_s);
  put(textures.b, level, x, y, o.frame.b / o.alpha_y, o.exponent);
  put(textures.n, level, x, y, o.frame.n, ward ? o.k_s * ward_factor(o) : 0);
}

}  // namespace burnish
