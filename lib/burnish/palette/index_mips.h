// The mip chain of an indexed normal map (Tarini et al., section 5.2).
//
// Indices cannot be averaged: a coarser texel is the entry that best approximates the average of the normals below it,
// largest dot product with their sum, among the entries of the material that covers most of it. A tie goes to the
// material whose summed normal is longer, then to the smaller id. Weights are those of core/mip.h, in integers, so that
// ties are exact.
#pragma once

#include <functional>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/normal/coding.h"
#include "burnish/palette/indexed_map.h"

namespace burnish {

enum class MipAverage {
  kLevel,  // of the quantized level below, as the paper does
  kBase,   // of the base normals, so that errors do not add up
};

struct IndexMipOptions {
  int levels = 0;  // with the base; 0: all
  MipAverage average = MipAverage::kLevel;
  FileRef source;  // the unquantized normals, of the same size, to be averaged instead of the base's; implies kBase
  NormalCoding coding;  // of the source
};

struct MipLevelStats {
  int width, height;
  double rms_deg;  // between its normals and the renormalised mean of the base normals (the source's, where given)
                   // under each texel
};

// The base, row by row.
struct IndexRows {
  const Palette& palette;
  int width, height;
  std::function<void(int first, int count, std::uint16_t* out)> read_rows;  // in ascending order, once
};

// Takes the next `count` rows of a level, in whatever order the levels come.
using IndexLevelSink = std::function<void(int level, int count, const std::uint16_t* rows)>;

// Gives the rows of all levels, the base's too, as they are made: a few of each are held. kUsage for more levels than
// there are; kMalformed for a source of another size. Runs in parallel; the result does not depend on threads.
std::vector<MipLevelStats> make_index_mips(const IndexRows& map, const IndexMipOptions& options,
                                           const IndexLevelSink& sink, const Progress& progress = {});

// Of a map in memory: replaces map.levels[1 …].
std::vector<MipLevelStats> build_index_mips(IndexedMap& map, const IndexMipOptions& options,
                                            const Progress& progress = {});

}  // namespace burnish
