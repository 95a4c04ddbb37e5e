// Normal maps to a histogram, and histograms to a palette.
#include <filesystem>
#include <set>

#include "burnish/core/wording.h"
#include "burnish/palette/shared_palette.h"
#include "quantize/quantize.h"

namespace burnish::cli {
namespace {

// Options that one of these has no use for.
void refuse(const CLI::App& app, const std::string& with, const std::vector<std::string>& flags) {
  for (const std::string& flag : flags)
    if (app.count(flag)) throw usage(flag + " does not go with " + with);
}

}  // namespace

Json write_histogram_of(Tool& tool, const QuantizeFiles& o) {
  refuse(
      tool.app(), "--histogram-output, which makes no palette and no map",
      {"--output", "--output-type", "--output-dir", "--extension", "--format", "--palette-output", "--palette",
       "--normals", "--target-error", "--engine", "--material-encoding", "--emit-rgb", "--dither", "--dither-amount"});
  const std::vector<MapFiles> maps = read_maps(tool, o);
  const FileRef file = tool.write(o.histogram_output);
  const CountStats s = count_maps(maps, o.quantize.coding, o.quantize.space, file, tool.progress());
  return {{"texels", s.texels},
          {"distinct_input_normals", s.distinct_normals},
          {"exact", s.exact},
          {"invalid_texels", s.invalid_texels}};
}

Json fit_to_histograms(Tool& tool, const QuantizeFiles& o) {
  refuse(tool.app(), "--histograms, of which a palette is made and no map",
         {"NORMAL", "--histogram-output", "--output", "--output-type", "--output-dir", "--extension", "--format",
          "--material", "--mask", "--palette", "--emit-rgb", "--dither", "--dither-amount", "--y", "--encoding",
          "--channels"});
  for (const std::string& path : o.histograms)
    if (path.size() > 1 && path[0] == '-') throw usage("--histograms: expected files, got the option " + path);
  if (o.output.palette_path.empty()) throw usage("--histograms needs --palette-output");
  const FileType type = o.output.palette_type();
  std::vector<FileRef> files;
  std::set<std::filesystem::path> seen;
  for (const std::string& path : o.histograms) {
    std::error_code is_no_file;
    const std::filesystem::path canonical = std::filesystem::canonical(path, is_no_file);
    if (!is_no_file && !seen.insert(canonical).second)
      throw usage("--histograms: '" + path + "' is given twice");
    files.push_back(tool.read(path));
  }
  const FileRef file = tool.write(o.output.palette_path);
  const SharedPalette result = fit_shared_palette(files, o.quantize, o.quantize.space, tool.progress());
  for (const SpaceOfFile& s : result.spaces) warn_of_space(tool, s.name, s.space, result.palette.space);
  write_palette(file, type, result.palette);
  return describe(result.stats, result.palette);
}

}  // namespace burnish::cli
