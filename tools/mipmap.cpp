// burnish-mipmap: the mip chain of a map.

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/palette/index_mips.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

// A printf-like name with one %d, or %02d and the like, filled in.
std::string level_name(const std::string& pattern, int level) {
  const std::size_t percent = pattern.find('%'), d = pattern.find('d', percent);
  const std::string width = d == std::string::npos ? "?" : pattern.substr(percent + 1, d - percent - 1);
  if (width.size() > 2 || width.find_first_not_of("0123456789") != std::string::npos ||
      pattern.find('%', percent + 1) != std::string::npos)
    throw CLI::ValidationError("--split", "expected a name with one %d for the level, got '" + pattern + "'");
  std::string number = std::to_string(level);
  if (!width.empty() && number.size() < std::size_t(std::stoi(width)))
    number.insert(0, std::stoi(width) - number.size(), width[0] == '0' ? '0' : ' ');
  return pattern.substr(0, percent) + number + pattern.substr(d + 1);
}

// Kinds that are known and not there yet are no mistake of the caller's.
void require_indexed(const std::string& kind) {
  if (kind == "indexed") return;
  for (const char* later : {"normal", "material", "ptm", "colour"})
    if (kind == later) throw Error(ErrorKind::kUnsupported, "--kind " + kind + " is not there yet; there is indexed");
  throw Error(ErrorKind::kUsage, "--kind: expected indexed, got '" + kind + "'");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-mipmap",
             "The mip chain of an indexed normal map: each coarser texel is the best entry for those below it.",
             "  burnish-mipmap rocks_q.exr -o rocks_m.exr\n"
             "  burnish-mipmap rocks_q.exr -o rocks_m.dds --palette-output rocks_p.exr\n"
             "  burnish-mipmap rocks_q.png --split 'rocks_%d.png' --source rocks_n.png"});
  CLI::App& app = tool.app();
  std::string input, palette, source, split, kind = "indexed";
  IndexedOutput output;
  IndexMipOptions options;
  int levels = 0;

  app.add_option("MAP", input, "Indexed normal map; '-' is standard input")->required();
  app.add_option("--palette", palette, "The palette of a MAP that holds indices only, as every DDS does")
      ->type_name("FILE");
  output.add_to(app);
  app.get_option("--output")->required(false);
  app.add_option("--kind", kind, "What MAP is; so far only indexed normal maps have mip chains (default)")
      ->type_name("indexed");
  auto* from = add_choice<MipAverage>(app, "--from", options.average,
                                      {{"level", MipAverage::kLevel}, {"base", MipAverage::kBase}},
                                      "Average the quantized level below (default) or the quantized base");
  app.add_option("--source", source, "Average these unquantized normals of the base instead")
      ->type_name("NORMAL")
      ->excludes(from);
  app.add_option("--levels", levels, "How many levels, with the base (default all)")
      ->check(in_range(1, 32))
      ->type_name("N");
  app.add_option("--split", split, "Write one file a level, named by a pattern such as 'name_%d.png'")
      ->type_name("PATTERN");
  add_normal_coding(app, options.coding, true);

  return tool.run(argc, argv, [&]() -> Json {
    if (output.path.empty() && split.empty()) throw Error(ErrorKind::kUsage, "--output or --split is required");
    require_indexed(kind);
    const FileType type = output.path.empty() ? FileType::kExr : output.type();
    const FileType split_type = split.empty() ? FileType::kExr : output.type_of(level_name(split, 0), "--split");
    const bool with_palette = !output.palette_path.empty();
    const FileType palette_type = with_palette ? output.palette_type() : type;
    const FileRef file = tool.read(input);
    const FileRef palette_beside = palette.empty() ? FileRef() : tool.read(palette);
    if (!source.empty()) options.source = tool.read(source);
    options.levels = levels;
    const FileRef chain = output.path.empty() ? FileRef() : tool.write(output.path);
    IndexedMap map = read_indexed_map(file, options.coding.green, palette_beside);
    if (!output.path.empty()) output.require_format(type, map.palette.normals.size(), output.path);
    if (!split.empty()) output.require_format(split_type, map.palette.normals.size(), level_name(split, 0));
    const int count = levels ? levels : level_count(map.width(), map.height());
    if (!chain.empty()) require_can_hold_levels(chain, type, count);
    std::vector<FileRef> parts;
    for (int l = 0; l < count && !split.empty(); l++) parts.push_back(tool.write(level_name(split, l)));
    const FileRef palette_file = with_palette ? tool.write(output.palette_path) : FileRef();
    const std::vector<MipLevelStats> stats = build_index_mips(map, options, tool.progress());
    if (!chain.empty()) write_indexed_map(chain, type, map);
    if (!palette_file.empty()) write_palette(palette_file, palette_type, map.palette);
    for (std::size_t l = 0; l < parts.size(); l++)
      write_indexed_map(parts[l], split_type, {map.palette, {map.levels[l]}});
    Json list = Json::array();
    for (const MipLevelStats& s : stats)
      list.push_back({{"width", s.width}, {"height", s.height}, {"rms_deg", s.rms_deg}});
    return {{"levels", list}};
  });
}
