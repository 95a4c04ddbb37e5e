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

struct BakeStats {
  int width = 0, height = 0;
  double scale = 1;  // of the vectors divided by α
  std::size_t clamped_texels = 0;
  double max_component = 0;                                      // largest of |t/α_x| and |b/α_y|, before the scale
  std::size_t degenerate_texels = 0, invalid_normal_texels = 0;  // as MaterialMaps counts them
};

struct BakedMaterial {
  MaterialTextures textures;  // one level
  BakeStats stats;
};

// An α below alpha_min, and what the samples cannot hold, is an error: kUsage for a number, kMalformed for a map. In
// integers k_s (but for ward, whose alpha is divided by its maximum) is at most 1 and N at most 128. kUsage for kFloat
// in integers. In parallel, each texel by itself.
BakedMaterial bake_material(const MaterialMaps& maps, const BakeOptions& options);

// Where the textures go.
struct MaterialTarget {
  FileRef t, b, n;
  FileType type = FileType::kPng;
};

// The same from files to files, in bands of rows: maps of parameters are read twice, as their values must be known for
// the textures' scale. Errors of MaterialReader and MaterialTexturesWriter too.
BakeStats bake_material(const MaterialSource& source, const BakeOptions& options, const MaterialTarget& target);

}  // namespace burnish
