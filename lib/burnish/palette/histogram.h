// Which normals a map holds, of which material, and how often: what a palette is fitted to.
//
// Every distinct normal is kept while there are at most 2^21 of them. A map of more is counted in octahedral bins of
// 2·16 bits, or as many fewer as it takes to have at most 2^20; a bin stands for the mean of what fell into it. Counted
// in integers, so that the result does not depend on the order, nor on threads.
#pragma once

#include <optional>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/progress.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/point_tree.h"
#include "burnish/palette/texel_keys.h"

namespace burnish {

// What the texels of a map are besides normals. Empty images: all of material 0, all unmasked.
struct TexelClasses {
  ByteImage material;  // id
  ByteImage mask;      // 0: the texel does not shape the palette

  int material_at(int x, int y) const { return material.data.empty() ? 0 : material.row(y)[x]; }
  bool counts_at(int x, int y) const { return mask.data.empty() || mask.row(y)[x] != 0; }
};

struct Histogram {
  std::vector<int> material;                        // ids that occur, ascending
  std::vector<std::vector<WeightedNormal>> groups;  // of each: distinct normals and their counts; never empty
  std::vector<char> counts;        // of each: whether any texel does; otherwise its points stand in, once each
  std::size_t texels = 0;          // that count
  std::size_t distinct = 0;        // (material, normal) pairs among them; bins where not exact
  std::size_t invalid_texels = 0;  // vectors without a direction
  bool exact = true;

  // Where exact: every key (material << 48 | texel key) that occurs, masked texels' too, numbered as keys and normals
  // below.
  KeyTable table;
  struct Key {
    int group;
    Vec3f normal;
    std::uint32_t count;  // texels that count
  };
  std::vector<Key> keys;
};

Histogram count_normals(TexelKeys& texels, const TexelClasses& classes, const Progress& progress = {});

}  // namespace burnish
