// Normal maps to indexed normal maps.
#include <filesystem>
#include <map>

#include "quantize/quantize.h"

namespace burnish::cli {
namespace {

// What CLI11 cannot say: which options go together.
void check(const QuantizeFiles& o) {
  if (!o.rgb.empty() && o.quantize.encoding == MaterialEncoding::kSplit)
    throw usage("--emit-rgb needs --material-encoding alpha or subcubes");
  if (o.output_dir.empty()) {
    if (o.output.path.empty()) throw usage("--output is required, or --output-dir");
    if (o.inputs.size() > 1)
      throw usage("--output is one file, not " + std::to_string(o.inputs.size()) + ": several maps need --output-dir");
    if (!o.extension.empty()) throw usage("--extension goes with --output-dir");
    return;
  }
  if (!o.output.path.empty()) throw usage("--output does not go with --output-dir, which names the files itself");
  if (!o.output.output_type.empty()) throw usage("--output-type does not go with --output-dir; --extension does");
}

// What is written for each map.
Paths output_paths(const QuantizeFiles& o) {
  if (o.output_dir.empty()) return {o.output.path};
  const std::string extension = o.extension.empty() ? "exr" : o.extension;
  Paths paths;
  std::map<std::string, std::string> input_of;
  for (const std::string& input : o.inputs) {
    paths.push_back((std::filesystem::path(o.output_dir) / (stem_of(input) + "." + extension)).string());
    const auto [other, is_new] = input_of.emplace(paths.back(), input);
    if (!is_new)
      throw usage("'" + other->second + "' and '" + input + "' would both be written to '" + paths.back() + "'");
  }
  return paths;
}

void reserve_rgb(Tool& tool, const QuantizeFiles& o, std::vector<MapFiles>& maps) {
  if (o.rgb.empty()) return;
  if (maps.size() > 1 && o.rgb.find(kStem) == std::string::npos)
    throw usage("--emit-rgb: expected a name with {stem} for the images of " + std::to_string(maps.size()) +
                " maps, got '" + o.rgb + "'");
  const Paths paths = for_each_map(o, "--emit-rgb", {o.rgb});
  for (std::size_t i = 0; i < maps.size(); i++) {
    WrittenAs{"an image of colours", {FileType::kPng}}.type_of(paths[i], "--emit-rgb");
    maps[i].rgb = tool.write(paths[i]);
  }
}

Json describe_maps(const QuantizeFiles& o, const Paths& outputs, const QuantizeResult& result) {
  Json list = Json::array();
  for (std::size_t i = 0; i < outputs.size(); i++) {
    const MapStats& s = result.maps[i];
    list.push_back({{"input", o.inputs[i]},
                    {"output", outputs[i]},
                    {"texels", s.texels},
                    {"rms_deg", s.rms_deg},
                    {"mean_deg", s.mean_deg},
                    {"p95_deg", s.p95_deg},
                    {"max_deg", s.max_deg},
                    {"invalid_texels", s.invalid_texels}});
  }
  return list;
}

}  // namespace

Json quantize_maps(Tool& tool, QuantizeFiles& o) {
  check(o);
  const Paths outputs = output_paths(o);
  const FileType type = o.output_dir.empty() ? o.output.type() : o.output.type_of(outputs[0], "--extension");
  const bool with_palette = !o.output.palette_path.empty();
  const FileType palette_type = with_palette ? o.output.palette_type() : type;
  std::vector<MapFiles> maps = read_maps(tool, o);
  if (!o.palette.empty()) o.quantize.palette = tool.read(o.palette);
  if (!o.output_dir.empty()) tool.make_directory(o.output_dir);
  std::vector<FileRef> files;
  for (const std::string& path : outputs) files.push_back(tool.write(path));
  reserve_rgb(tool, o, maps);
  const FileRef palette_file = with_palette ? tool.write(o.output.palette_path) : FileRef();

  const auto write = [&](std::size_t i, const Palette& palette, int width, int height) -> IndexRowSink {
    o.output.require_format(type, palette.normals.size(), outputs[i]);
    const auto writer = std::make_shared<IndexedMapWriter>(files[i], type, palette, width, height);
    return [writer](int count, const std::uint16_t* rows) { writer->write_rows(0, count, rows); };
  };
  const QuantizeResult result = quantize_normal_maps(std::move(maps), o.quantize, write, tool.progress());
  for (std::size_t i = 0; i < outputs.size(); i++)
    warn_of_space(tool, o.inputs[i], result.maps[i].recorded_space, result.palette.space);
  if (with_palette) write_palette(palette_file, palette_type, result.palette);
  Json stats = describe(result.stats, result.palette);
  if (!o.output_dir.empty()) stats["maps"] = describe_maps(o, outputs, result);
  return stats;
}

}  // namespace burnish::cli
