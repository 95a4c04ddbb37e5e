// The normal maps that one palette is made for: opened one at a time, as often as it takes.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/image_io.h"
#include "burnish/palette/texel_keys.h"

namespace burnish {

struct MapFiles {
  FileRef normals;
  FileRef material = {};  // one channel, uint8: the id of each texel; none: all are of material 0
  FileRef mask = {};      // texels where it is 0 do not shape the palette and do not count in the figures
  FileRef rgb = {};       // to write: the texels as colours of the cube (material_cube.h); none where empty
};

// What the texels of a map are besides normals. Empty images: all of material 0, all unmasked.
struct TexelClasses {
  ByteImage material;  // id
  ByteImage mask;      // 0: the texel does not shape the palette

  int material_at(int x, int y) const { return material.data.empty() ? 0 : material.row(y)[x]; }
  bool counts_at(int x, int y) const { return mask.data.empty() || mask.row(y)[x] != 0; }
};

struct OpenMap {
  TexelKeys texels;
  TexelClasses classes;
};

class MapSet {
 public:
  MapSet(std::vector<MapFiles> maps, NormalCoding coding) : maps_(std::move(maps)), coding_(std::move(coding)) {}

  std::size_t size() const { return maps_.size(); }
  const MapFiles& files(std::size_t i) const { return maps_[i]; }

  // The map, until another is asked for: one at a time is kept, so that memory does not grow with their number. Errors
  // as TexelKeys, read_ids and read_mask.
  OpenMap& open(std::size_t i);

 private:
  std::vector<MapFiles> maps_;
  NormalCoding coding_;
  std::size_t opened_ = 0;
  std::optional<OpenMap> open_;
};

}  // namespace burnish
