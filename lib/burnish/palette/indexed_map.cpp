#include "burnish/palette/indexed_map.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/whole_image.h"
#include "burnish/palette/files/indexed_files.h"
#include "burnish/palette/indexed_rows.h"

namespace burnish {

using detail::format_of, detail::IndexFormat;
int Palette::interval_of(int index) const {
  const auto after = std::upper_bound(materials.begin(), materials.end(), index,
                                      [](int i, const MaterialInterval& m) { return i < m.first; });
  return int(after - materials.begin()) - 1;
}

bool is_indexed_map(const FileRef& file) {
  switch (format_of(file)) {
    case IndexFormat::kPng:
      return detail::is_indexed_png(file);
    case IndexFormat::kExr:
      return detail::is_indexed_exr(file);
    case IndexFormat::kKtx2:
      return detail::is_indexed_ktx2(file);
    case IndexFormat::kDds:
      return detail::is_indexed_dds(file);
    default:
      return false;
  }
}

IndexedMap read_indexed_map(const FileRef& file, GreenAxis green, const FileRef& palette) {
  IndexedMapReader reader(file, green, palette);
  IndexedMap map{reader.palette(), {}};
  for (int l = 0; l < reader.levels(); l++) {
    IndexImage& level = map.levels.emplace_back();
    level.width = level_size(reader.width(), l), level.height = level_size(reader.height(), l);
    level.data = read_whole<std::uint16_t>(
        file.name, level.height, std::size_t(level.width),
        [&](int first, int count, std::uint16_t* out) { reader.read_rows(l, first, count, out); });
  }
  return map;
}

bool has_own_palette(const FileRef& file) {
  switch (format_of(file)) {
    case IndexFormat::kPng:
      return detail::read_palette_png(file).has_value();
    case IndexFormat::kExr:
      return detail::is_indexed_exr(file) || detail::read_palette_exr(file);
    case IndexFormat::kKtx2:
    case IndexFormat::kDds:
      return true;
    default:
      return false;
  }
}

Palette read_palette(const FileRef& file, GreenAxis green) {
  const IndexFormat format = format_of(file);
  if (const auto map = detail::open_indexed(file, format, green)) {
    if (map->palette.normals.empty())
      throw file_error(ErrorKind::kMalformed, file.name, "expected a palette, got a map that holds indices only");
    IndexedMapReader reader(file, green);
    reader.check();  // a damaged map is not to be trusted with its palette
    return reader.palette();
  }
  std::optional<Palette> own;
  if (format == IndexFormat::kPng) own = detail::read_palette_png(file);
  if (format == IndexFormat::kExr) own = detail::read_palette_exr(file);
  if (own) return *own;
  NormalCoding coding;
  coding.green = green;
  NormalReader reader(file, coding);
  if (reader.height() != 1 || reader.width() > kMaxPaletteSize)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected an indexed normal map or a palette of N x 1 texels, got " +
                         std::to_string(reader.width()) + "x" + std::to_string(reader.height()));
  Palette palette;
  palette.normals.resize(reader.width());
  reader.read_rows(0, 1, palette.normals.data());
  palette.materials = {{0, 0, reader.width()}};
  return palette;
}

void require_can_hold_levels(const FileRef& file, FileType type, int levels) {
  using enum FileType;
  if (type != kExr && type != kPng && type != kKtx2 && type != kDds)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     std::string("an indexed normal map is written as EXR, PNG, KTX2 or DDS, not ") + name(type));
  if (type == kPng && levels > 1)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "PNG holds one level, not " + std::to_string(levels) +
                         " (EXR, KTX2 and DDS hold all; --split writes one file a level)");
}

void write_indexed_map(const FileRef& file, FileType type, const IndexedMap& map) {
  IndexedMapWriter writer(file, type, map.palette, map.width(), map.height(), int(map.levels.size()));
  constexpr int kRows = 512;  // codecs copy what they are given
  for (std::size_t l = 0; l < map.levels.size(); l++)
    for (int y = 0; y < map.levels[l].height; y += kRows)
      writer.write_rows(int(l), std::min(kRows, map.levels[l].height - y), map.levels[l].row(y));
}

void write_palette(const FileRef& file, FileType type, const Palette& palette) {
  if (type == FileType::kExr) return detail::write_palette_exr(file, palette);
  if (type == FileType::kPng) return detail::write_palette_png(file, palette);
  throw file_error(ErrorKind::kUnsupported, file.name,
                   std::string("a palette is written as EXR or PNG, not ") + name(type));
}

}  // namespace burnish
