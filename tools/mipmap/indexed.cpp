// The chain of an indexed normal map.
#include "burnish/core/mip.h"
#include "burnish/palette/indexed_rows.h"
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
  IndexedMapReader map(file, o.coding.green, palette);
  const std::size_t normals = map.palette().normals.size();
  if (!chain.empty()) output.require_format(type, normals, output.path);
  if (!o.split.empty()) output.require_format(split_type, normals, level_name(o.split, 0));
  const int count = levels_to_make(map.width(), map.height(), o.levels);
  if (!chain.empty()) require_can_hold_levels(chain, type, count);
  std::vector<FileRef> parts;
  for (int l = 0; l < count && !o.split.empty(); l++) parts.push_back(tool.write(level_name(o.split, l)));
  const FileRef palette_file = with_palette ? tool.write(output.palette_path) : FileRef();

  std::optional<IndexedMapWriter> whole;
  if (!chain.empty()) whole.emplace(chain, type, map.palette(), map.width(), map.height(), count);
  std::vector<IndexedMapWriter> split;
  for (std::size_t l = 0; l < parts.size(); l++)
    split.emplace_back(parts[l], split_type, map.palette(), level_size(map.width(), int(l)),
                       level_size(map.height(), int(l)));
  const auto write = [&](int level, int rows, const std::uint16_t* indices) {
    if (whole) whole->write_rows(level, rows, indices);
    if (!split.empty()) split[level].write_rows(0, rows, indices);
  };
  const auto read = [&](int first, int rows, std::uint16_t* out) { map.read_rows(0, first, rows, out); };
  const std::vector<MipLevelStats> stats =
      make_index_mips({map.palette(), map.width(), map.height(), read}, options, write, tool.progress());
  if (!palette_file.empty()) write_palette(palette_file, palette_type, map.palette());
  Json levels = Json::array();
  for (const MipLevelStats& s : stats)
    levels.push_back({{"width", s.width}, {"height", s.height}, {"rms_deg", s.rms_deg}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
