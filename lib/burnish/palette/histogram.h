// What a palette is fitted to: of each material the distinct normals, and how often they occur (NormalCounts).
#pragma once

#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/fit/weighted_normal.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/normal_counts.h"

namespace burnish {

struct Histogram {
  std::vector<int> material;                        // ids that occur, ascending
  std::vector<std::vector<WeightedNormal>> groups;  // of each: distinct normals and their counts; never empty
  // Of each: whether any texel counts. A material that is masked out whole needs an entry all the same, and no more:
  // the mean of its normals, once, is its group.
  std::vector<char> counts;
  std::size_t distinct = 0;  // (material, normal) pairs among those that count; bins where not exact
  bool exact = true;

  std::vector<NormalCounts::Texels> maps;  // of each map

  // Where exact: every key that occurs, masked texels' too, numbered as keys and normals below.
  static std::uint64_t key(int material, std::uint64_t texel) { return NormalCounts::key(material, texel); }
  KeyTable table;
  struct Key {
    int group;
    Vec3f normal;
    std::uint64_t count;  // texels that count
  };
  std::vector<Key> keys;
};

// `maps` stays empty.
Histogram histogram_of(NormalCounts counts);

Histogram count_normals(MapSet& maps, const Progress& progress = {});

}  // namespace burnish
