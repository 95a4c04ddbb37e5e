// The chain of an indexed normal map.
#include "burnish/core/mip.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {

Json mip_indices(Tool& tool, const MipmapOptions& o, const FileRef& file) {
  const IndexedOutput& output = o.output;
  const FileType type = output.path.empty() ? FileType::kExr : output.type();
  const FileType split_type = o.split.empty() ? FileType::kExr : output.type_of(level_name(o.split, 0), "--split");
  const bool with_palette = !output.palette_path.empty();
  const FileType palette_type = with_palette ? output.palette_type() : type;
  const FileRef palette = o.palette.empty() ? FileRef() : tool.read(o.palette);
  const IndexMipOptions options{o.levels, o.average, o.source.empty() ? FileRef() : tool.read(o.source), o.coding};
  const FileRef chain = output.path.empty() ? FileRef() : tool.write(output.path);
  IndexedMap map = read_indexed_map(file, o.coding.green, palette);
  if (!chain.empty()) output.require_format(type, map.palette.normals.size(), output.path);
  if (!o.split.empty()) output.require_format(split_type, map.palette.normals.size(), level_name(o.split, 0));
  const int count = levels_to_make(map.width(), map.height(), o.levels);
  if (!chain.empty()) require_can_hold_levels(chain, type, count);
  std::vector<FileRef> parts;
  for (int l = 0; l < count && !o.split.empty(); l++) parts.push_back(tool.write(level_name(o.split, l)));
  const FileRef palette_file = with_palette ? tool.write(output.palette_path) : FileRef();
  const std::vector<MipLevelStats> stats = build_index_mips(map, options, tool.progress());
  if (!chain.empty()) write_indexed_map(chain, type, map);
  if (!palette_file.empty()) write_palette(palette_file, palette_type, map.palette);
  for (std::size_t l = 0; l < parts.size(); l++)
    write_indexed_map(parts[l], split_type, {map.palette, {map.levels[l]}});
  Json levels = Json::array();
  for (const MipLevelStats& s : stats)
    levels.push_back({{"width", s.width}, {"height", s.height}, {"rms_deg", s.rms_deg}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
