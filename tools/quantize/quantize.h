// What the jobs of burnish-quantize share: maps to indexed maps, maps to a histogram, histograms to a palette.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/palette/quantize.h"
#include "cli/options.h"
#include "cli/tool.h"

namespace burnish::cli {

using Paths = std::vector<std::string>;

struct QuantizeFiles {
  Paths inputs, materials, masks, histograms;
  std::string histogram_output, palette, rgb, output_dir, extension;
  IndexedOutput output;
  QuantizeOptions quantize;
};

inline Error usage(const std::string& message) { return Error(ErrorKind::kUsage, message); }

inline const std::string kStem = "{stem}";  // a map's own, in the names of what goes with it
std::string stem_of(const std::string& input);
// The file that goes with each map: one for all, or one for each in their order; {stem} is the map's own stem.
Paths for_each_map(const QuantizeFiles& o, const std::string& flag, const Paths& given);
// The maps, each with its material and mask.
std::vector<MapFiles> read_maps(Tool& tool, const QuantizeFiles& o);

// What is said of a palette.
Json describe(const QuantizeStats& stats, const Palette& palette);
// Warns of a file whose normals are in another space than its palette is recorded in.
void warn_of_space(Tool& tool, const std::string& file, std::optional<NormalSpace> said, NormalSpace recorded);

// Each writes what was asked for and returns the report's stats.
Json quantize_maps(Tool& tool, QuantizeFiles& o);
Json write_histogram_of(Tool& tool, const QuantizeFiles& o);
Json fit_to_histograms(Tool& tool, const QuantizeFiles& o);

}  // namespace burnish::cli
