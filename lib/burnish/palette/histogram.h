// Which normals maps hold, of which material, and how often: what a palette is fitted to.
//
// The counts of several maps are added up. Every distinct normal is kept while there are at most 2^21 of them; of more,
// all are counted in octahedral bins of 2·16 bits, or as many fewer as it takes to have at most 2^20; a bin stands for
// the mean of what fell into it. Counted in integers, so that the result does not depend on the order, of the maps
// neither, nor on threads. Memory does not grow with the number of maps.
#pragma once

#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/fit/weighted_normal.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/map_set.h"

namespace burnish {

struct Histogram {
  std::vector<int> material;                        // ids that occur, ascending
  std::vector<std::vector<WeightedNormal>> groups;  // of each: distinct normals and their counts; never empty
  // Of each: whether any texel counts. A material that is masked out whole needs an entry all the same, and no more:
  // the mean of its normals, once, is its group.
  std::vector<char> counts;
  std::size_t distinct = 0;  // (material, normal) pairs among those that count; bins where not exact
  bool exact = true;

  struct Texels {
    std::uint64_t counted = 0;
    std::uint64_t invalid = 0;  // of them, vectors without a direction
  };
  std::vector<Texels> maps;  // of each map

  // Where exact: every key (material << TexelKeys::kBits | texel key) that occurs, masked texels' too, numbered as keys
  // and normals below.
  static std::uint64_t key(int material, std::uint64_t texel) {
    return std::uint64_t(material) << TexelKeys::kBits | texel;
  }
  KeyTable table;
  struct Key {
    int group;
    Vec3f normal;
    std::uint64_t count;  // texels that count
  };
  std::vector<Key> keys;
};

Histogram count_normals(MapSet& maps, const Progress& progress = {});

}  // namespace burnish
