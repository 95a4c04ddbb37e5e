// The normal maps that one palette is made for: opened one at a time, as often as it takes, and read in rows.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "burnish/core/byte_rows.h"
#include "burnish/core/image_io.h"
#include "burnish/palette/texel_keys.h"

namespace burnish {

struct MapFiles {
  FileRef normals;
  FileRef material = {};  // one channel, uint8: the id of each texel; none: all are of material 0
  FileRef mask = {};      // texels where it is 0 do not shape the palette and do not count in the figures
  FileRef rgb = {};       // to write: the texels as colours of the cube (material_cube.h); none where empty
};

// Rows of a map: the texels' keys, materials, and whether they count. Rows are numbered from 0 here.
struct TexelRows {
  int width = 0, count = 0;
  std::vector<std::uint64_t> keys;
  std::vector<std::uint8_t> material;  // id; empty: all of material 0
  std::vector<std::uint8_t> mask;      // 0: the texel does not shape the palette; empty: all do

  const std::uint64_t* row(int y) const { return keys.data() + std::size_t(y) * width; }
  int material_at(int x, int y) const { return material.empty() ? 0 : material[std::size_t(y) * width + x]; }
  bool counts_at(int x, int y) const { return mask.empty() || mask[std::size_t(y) * width + x] != 0; }
};

class OpenMap {
 public:
  // Errors as TexelKeys and ByteRows.
  OpenMap(const MapFiles& files, const NormalCoding& coding);

  int width() const { return texels_.width(); }
  int height() const { return texels_.height(); }
  // Rows [first, first + count); in any order, ascending is fast.
  void read_rows(int first, int count, TexelRows& out);

 private:
  TexelKeys texels_;
  std::optional<ByteRows> material_, mask_;
};

class MapSet {
 public:
  MapSet(std::vector<MapFiles> maps, NormalCoding coding) : maps_(std::move(maps)), coding_(std::move(coding)) {}

  std::size_t size() const { return maps_.size(); }
  const MapFiles& files(std::size_t i) const { return maps_[i]; }

  // The map, until another is asked for: one at a time is kept, so that memory does not grow with their number.
  OpenMap& open(std::size_t i);

 private:
  std::vector<MapFiles> maps_;
  NormalCoding coding_;
  std::size_t opened_ = 0;
  std::optional<OpenMap> open_;
};

}  // namespace burnish
