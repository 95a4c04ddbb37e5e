// Material textures as maps for renderers of today.
//
//   alpha      R α_x, G α_y, B k_s
//   direction  t, unit, in tangent space
//   khr        KHR_materials_anisotropy: R, G the direction of the wider axis, biased, B its strength s; and beside it
//              the roughness r of the narrower: α_b = r², α_t = α_b + (1 − α_b) s²
//
// glTF knows α up to 1, and of it GGX's lobe; ward's is Beckmann's of the same α, and blinn-phong's α √(2/(N+4)) is as
// wide as either.
#pragma once

#include <cstddef>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/material/material_textures.h"

namespace burnish {

// kUnsupported for banks, which has no α.
void require_alpha(MaterialModel model);

// Of every level, base first; of α as require_alpha().
std::vector<Image> direction_maps(const MaterialTextures& textures);
std::vector<Image> alpha_maps(const MaterialTextures& textures);

struct KhrMaps {
  std::vector<Image> anisotropy, roughness;  // 3 channels, 1 channel
  std::size_t wider_texels = 0;              // of all levels, those whose α is beyond 1: stored as 1
};
KhrMaps khr_maps(const MaterialTextures& textures);

}  // namespace burnish
