#include "burnish/palette/map_set.h"

namespace burnish {

OpenMap::OpenMap(const MapFiles& files, const NormalCoding& coding) : texels_(files.normals, coding) {
  if (!files.material.empty()) material_.emplace(ByteRows::of_ids(files.material, width(), height()));
  if (!files.mask.empty()) mask_.emplace(ByteRows::of_mask(files.mask, width(), height()));
}

void OpenMap::read_rows(int first, int count, TexelRows& out) {
  const std::size_t texels = std::size_t(width()) * count;
  out.width = width(), out.count = count;
  out.keys.resize(texels);
  texels_.read_rows(first, count, out.keys.data());
  const auto read = [&](std::optional<ByteRows>& from, std::vector<std::uint8_t>& to) {
    to.resize(from ? texels : 0);
    if (from) from->read(first, count, to.data());
  };
  read(material_, out.material);
  read(mask_, out.mask);
}

OpenMap& MapSet::open(std::size_t i) {
  if (open_ && opened_ == i) return *open_;
  open_.reset();  // before the next takes memory
  opened_ = i;
  return open_.emplace(maps_[i], coding_);
}

}  // namespace burnish
