// The colour table C: every normal of a palette shaded once a frame (Tarini et al., section 5.1).
//
// What an entry holds depends on how colours are blended (section 7):
//   RGB               the colour itself                                          (r, g, b)
//   intensity         α, to multiply a base colour with                          (α)
//   intensity + RGB   the reflected light, and α                                 (r, g, b, α)
// α is the luminance of the diffuse part. Single precision: of colours up to 1, within 1e-6 of the models' own double
// precision.
#pragma once

#include <span>
#include <vector>

#include "burnish/palette/indexed_map.h"
#include "burnish/render/blend.h"
#include "burnish/render/lighting/material.h"
#include "burnish/render/transform.h"

namespace burnish {

enum class TableKind { kRgb, kIntensity, kIntensityAndRgb };

class PaletteTable {
 public:
  // `materials`: one an interval of the palette, none null; they outlive the table. Stretching the normals by the
  // transform's scale is done here, once. An intensity alone is enough for a base colour where no material reflects
  // anything on top of its diffuse part.
  PaletteTable(const Palette& palette, std::span<const Material* const> materials, const Transform& transform,
               Blend blend);

  // Shades all entries: directions go into object space by the inverse of the model's turn, and an interval is one loop
  // over each of its material's models, so that no entry asks which it has (section 6). In parallel; an entry depends
  // on its own normal only.
  void shade(const Illumination& world);

  TableKind kind() const { return kind_; }
  int channels() const { return int(planes_.size()); }
  // Of all entries, one channel.
  const std::vector<float>& plane(int channel) const { return planes_[channel]; }

 private:
  std::span<const Material* const> materials_;
  std::vector<MaterialInterval> intervals_;
  Rotation rotation_;
  TableKind kind_;
  std::vector<double> x_, y_, z_;  // unit normals, stretched
  std::vector<std::vector<float>> planes_;
};

}  // namespace burnish
