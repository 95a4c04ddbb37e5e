#include "burnish/palette/map_set.h"

namespace burnish {

OpenMap& MapSet::open(std::size_t i) {
  if (open_ && opened_ == i) return *open_;
  open_.reset();  // before the next takes memory
  const MapFiles& files = maps_[i];
  OpenMap map{TexelKeys(files.normals, coding_), {}};
  const int w = map.texels.width(), h = map.texels.height();
  if (!files.material.empty()) map.classes.material = read_ids(files.material, w, h);
  if (!files.mask.empty()) map.classes.mask = read_mask(files.mask, w, h);
  opened_ = i;
  return open_.emplace(std::move(map));
}

}  // namespace burnish
