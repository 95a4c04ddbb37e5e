// Material textures baked from a material's maps (Kautz & Seidel, sections 3 and 4.1).
#pragma once

#include <cstddef>

#include "burnish/core/file_type.h"
#include "burnish/material/material_maps.h"
#include "burnish/material/material_textures.h"

namespace burnish {

enum class VectorRange {
  kCombiner,  // [0,1]: unit vectors as ½v + ½, those divided by α scaled by the least α before
  kFloat,     // as they are
};

struct BakeOptions {
  VectorRange range = VectorRange::kCombiner;
  double alpha_min = 0.25;                 // of kCombiner; above 0
  bool clamp_alpha = false;                // raises what is below it, also where α enters otherwise; an error without
  SampleType sample = SampleType::kUint8;  // what the textures will be stored in
};

struct BakedMaterial {
  MaterialTextures textures;  // one level
  double scale = 1;           // of the vectors divided by α
  std::size_t clamped_texels = 0;
  double max_component = 0;  // largest of |t/α_x| and |b/α_y|, before the scale
};

// An α below alpha_min, and what the samples cannot hold, is an error: kUsage for a number, kMalformed for a map. In
// integers k_s (but for ward, whose alpha is divided by its maximum) is at most 1 and N at most 128. kUsage for kFloat
// in integers. In parallel, each texel by itself.
BakedMaterial bake_material(const MaterialMaps& maps, const BakeOptions& options);

}  // namespace burnish
