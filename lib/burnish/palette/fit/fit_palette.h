// A palette for a histogram: an engine's entries, material after material, each along the curve of palette_order.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/engine.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/indexed_map.h"
#include "burnish/palette/material_cube.h"

namespace burnish {

// Which palette is wanted.
struct PaletteOptions {
  int normals = 256;                       // 2 to 65536
  std::optional<double> target_error_deg;  // instead: the smallest palette whose RMS angle, each texel taking its
                                           // nearest entry, is at most that
  Engine engine = Engine::kSpherical;
  MaterialEncoding encoding = MaterialEncoding::kSplit;
};

// kUsage for options out of range, kUnsupported for more than the engine holds.
void require_sane(const PaletteOptions& options);
// kUnsupported where the encoding does not hold so many materials; `files` is where they are, for the message.
void require_encodable(MaterialEncoding encoding, std::size_t materials, const std::string& files);

// Of sane options, materials that are encodable, and `files` with them. kMalformed for fewer normals than materials;
// kThreshold where no palette that the engine can make reaches the target error.
Palette fit_palette(const Histogram& histogram, const PaletteOptions& options, NormalSpace space,
                    const std::string& files, const Progress& progress = {});

// Entries by group, in any order, as a palette; `materials` are the groups' ids, ascending. Groups without entries are
// left out.
Palette palette_of(std::vector<std::vector<Vec3f>> groups, const std::vector<int>& materials, NormalSpace space);

}  // namespace burnish
