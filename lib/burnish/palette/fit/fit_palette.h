// A palette for a histogram: an engine's entries, material after material, each along the curve of palette_order.h.
#pragma once

#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/engine.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/indexed_map.h"
#include "burnish/palette/material_cube.h"

namespace burnish {

struct FitOptions {
  Engine engine = Engine::kSpherical;
  MaterialEncoding encoding = MaterialEncoding::kSplit;
  NormalSpace space = NormalSpace::kTangent;
};

// At most n entries, at least one of each material. kMalformed where n is less than the number of materials;
// kUnsupported for more than the engine or the encoding holds.
Palette fit_palette(const Histogram& histogram, const FitOptions& options, int n, const Progress& progress = {});

// The smallest palette whose RMS angle, each texel taking its nearest entry, is at most that. kThreshold where none
// that the engine can make is.
Palette fit_palette_to_error(const Histogram& histogram, const FitOptions& options, double target_deg,
                             const Progress& progress = {});

// Entries by group, in any order, as a palette; `materials` are the groups' ids, ascending. Groups without entries are
// left out.
Palette palette_of(std::vector<std::vector<Vec3f>> groups, const std::vector<int>& materials, NormalSpace space);

}  // namespace burnish
