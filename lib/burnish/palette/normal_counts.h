// Which normals maps hold, of which material, and how often.
//
// Every distinct normal is kept while there are at most 2^21 of them; of more, all are counted in octahedral bins of
// 2·16 bits, or as many fewer as it takes to have at most 2^20 (NormalBins). Counted in integers: neither the order of
// the maps shows, nor threads, nor whether maps were counted together or by themselves and then added up. Memory does
// not grow with the number of maps.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/map_set.h"
#include "burnish/palette/normal_bins.h"

namespace burnish {

class NormalCounts {
 public:
  static constexpr std::size_t kMostKeys = std::size_t(1) << 21;

  struct Texels {
    std::uint64_t counted = 0;  // those that are not masked out
    std::uint64_t invalid = 0;  // of them, vectors without a direction
  };

  // A texel's key (TexelKeys) and its material, below 2^61.
  static std::uint64_t key(int material, std::uint64_t texel) {
    return std::uint64_t(material) << TexelKeys::kBits | texel;
  }
  struct Key {
    std::uint64_t key;
    std::uint64_t texels = 0, masked = 0;  // that count, and that do not
    bool invalid = false;                  // without a direction

    int material() const { return int(key >> TexelKeys::kBits); }
    std::uint64_t texel() const { return key & ((std::uint64_t(1) << TexelKeys::kBits) - 1); }
  };

  NormalCounts() = default;
  // Of what was too much to be kept exactly; `invalid` as in Texels.
  NormalCounts(NormalBins bins, std::uint64_t invalid);

  // The texels of maps; of each, how many. Errors as MapSet::open and TexelKeys::read_rows; kMalformed for a mask of
  // zeros. All that add throw kUnsupported for more texels than a bin holds.
  std::vector<Texels> add(MapSet& maps, const Progress& progress = {});
  // What others have counted.
  void add(const NormalCounts& other);
  // Texels of one normal; whether it is invalid is found out here.
  void add(const Key& key);

  const Texels& texels() const { return texels_; }
  bool exact() const { return !bins_; }
  // Where exact: what occurs, masked texels' keys too, in no order.
  const std::vector<Key>& keys() const { return keys_; }
  // Where not.
  const NormalBins& bins() const { return *bins_; }

  // Gives the keys away, ascending, and a table of their numbers.
  std::vector<Key> take_sorted_keys(KeyTable& numbers);

 private:
  struct Lane;
  struct BinLane;
  Texels add(OpenMap& map, const Progress& progress);
  static void count(const TexelRows& rows, std::vector<Lane>& lanes);
  // What lanes have counted, which are empty then; changes to bins where it becomes too much.
  void take(std::vector<Lane>& lanes);
  static void count_in_bins(const TexelRows& rows, std::vector<BinLane>& lanes);
  void change_to_bins();
  bool add_to_bins(const Key& key);

  std::vector<Key> keys_;
  KeyTable place_;  // position in keys_ plus one
  std::optional<NormalBins> bins_;
  Texels texels_;
};

}  // namespace burnish
