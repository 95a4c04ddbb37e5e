// A palette's index for every texel of a map: the nearest entry of the texel's own material, or dithered.
//
// Undithered, each distinct normal of the histogram is looked up once. Parallel; the indices do not depend on threads.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/angle_stats.h"
#include "burnish/palette/dither.h"
#include "burnish/palette/histogram.h"
#include "burnish/palette/indexed_rows.h"
#include "burnish/palette/map_set.h"

namespace burnish {

// How to find the nearest entries of each of the histogram's groups in a palette. kMalformed, naming the palette, where
// it has no entry of a material.
std::vector<EntryRange> entry_ranges(const Palette& palette, const std::vector<int>& materials,
                                     const std::string& palette_name);

// The angles of all maps when each texel takes its nearest entry, by their distinct normals.
AngleStats nearest_angles(const Histogram& histogram, const Palette& palette, const std::vector<EntryRange>& ranges);

class Mapper {
 public:
  // `histogram` and `palette` outlive it. kMalformed as entry_ranges. `amount` of dithering in [0,1].
  Mapper(const Histogram& histogram, const Palette& palette, const std::string& palette_name, Dither dither,
         double amount);

  // The indices of a map that the histogram has counted, from the top; the angles of its texels that count. Bands of
  // rows are read, mapped and given away side by side: what is held does not grow with the map's height.
  AngleStats run(OpenMap& map, const IndexRowSink& sink, const Progress& progress) const;

 private:
  struct Band;
  AngleStats look_up(const TexelRows& rows, std::uint16_t* out) const;
  void look_up_row(const TexelRows& rows, int y, std::uint16_t* out, AngleStats& angles) const;
  AngleStats search(const TexelRows& rows, const TexelRows* below, ErrorDiffusion& diffusion, std::uint16_t* out) const;
  Band decode(const TexelRows& rows, const TexelRows* below) const;
  void nearest_row(const Band& band, std::size_t row, std::uint16_t* out) const;
  std::uint16_t region(const TexelRows& rows, int x, int y) const;

  const Histogram& histogram_;
  const Palette& palette_;
  std::vector<EntryRange> ranges_;
  Dither dither_;
  double amount_;
  std::vector<std::uint16_t> group_;                  // of a material id
  std::vector<const EntryRange*> ranges_of_regions_;  // two regions a group: masked texels, and those that count
  std::vector<std::uint16_t> nearest_;                // of each key of the histogram
  std::vector<double> angle_;                         // to it; empty for a single map
};

}  // namespace burnish
