// A palette for many maps by way of their histograms: each map is counted by itself and its histogram kept in a file,
// so that a palette is fitted anew without reading the maps that have not changed.
//
// The palette is the one that quantize_normal_maps fits to all of the maps at once.
#pragma once

#include <optional>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/quantize.h"

namespace burnish {

struct CountStats {
  std::size_t texels = 0;          // that count
  std::size_t invalid_texels = 0;  // of them, vectors without a direction, taken as (0,0,1)
  std::size_t distinct_normals = 0;
  bool exact = true;  // false: too many to be kept, and counted in bins, which distinct_normals is then of
};

// Writes the histogram of maps (histogram_file.h); their `rgb` does not matter. The space of their normals is what they
// say, unless `space` is given. Errors as quantize_normal_maps' of maps, kIo where the file cannot be written.
CountStats count_maps(std::vector<MapFiles> maps, const NormalCoding& coding, std::optional<NormalSpace> space,
                      const FileRef& histogram, const Progress& progress = {});

struct SharedPalette {
  Palette palette;
  QuantizeStats stats;              // undithered
  std::vector<SpaceOfFile> spaces;  // what each histogram says
};

// The palette of all maps that histograms were counted of, and how near it comes to their normals. `space`: none: what
// the histograms say, otherwise tangent. Errors as quantize_normal_maps' of palettes and read_histogram's; kMalformed
// for histograms in different spaces where nothing else decides.
SharedPalette fit_shared_palette(const std::vector<FileRef>& histograms, const PaletteOptions& options,
                                 std::optional<NormalSpace> space, const Progress& progress = {});

}  // namespace burnish
