// burnish-quantize: normal maps to indexed normal maps with one palette.
#include "burnish/palette/quantize.h"

#include <filesystem>
#include <map>

#include "burnish/core/error.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

using Paths = std::vector<std::string>;

struct Options {
  Paths inputs, materials, masks;
  std::string palette, rgb, output_dir, extension;
  IndexedOutput output;
  QuantizeOptions quantize;
};

const std::string kStem = "{stem}";  // a map's own, in the names of what goes with it

Error usage(const std::string& message) { return Error(ErrorKind::kUsage, message); }

// What CLI11 cannot say: which options go together.
void check(const Options& o) {
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

std::string stem_of(const std::string& input) {
  if (input == "-") throw file_error(ErrorKind::kUsage, kStandardInput, "has no name to call other files by");
  return std::filesystem::path(input).stem().string();
}

// The file that goes with each map: one for all, or one for each in their order; {stem} is the map's own stem.
Paths for_each_map(const Options& o, const std::string& flag, const Paths& given) {
  if (given.empty()) return Paths(o.inputs.size());
  if (const std::size_t maps = o.inputs.size(); given.size() != 1 && given.size() != maps)
    throw usage(flag + ": expected one file" + (maps > 1 ? " or " + std::to_string(maps) : "") + ", got " +
                std::to_string(given.size()));
  Paths paths;
  for (std::size_t i = 0; i < o.inputs.size(); i++) {
    std::string path = given[given.size() == 1 ? 0 : i];
    for (std::size_t at = 0; (at = path.find(kStem, at)) != std::string::npos;) {
      const std::string stem = stem_of(o.inputs[i]);
      path.replace(at, kStem.size(), stem);
      at += stem.size();
    }
    paths.push_back(path);
  }
  return paths;
}

// What is written for each map.
Paths output_paths(const Options& o) {
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

std::vector<MapFiles> read_inputs(Tool& tool, Options& o) {
  const Paths materials = for_each_map(o, "--material", o.materials), masks = for_each_map(o, "--mask", o.masks);
  std::vector<MapFiles> maps(o.inputs.size());
  const auto read = [&](const Paths& paths, FileRef MapFiles::*file) {
    for (std::size_t i = 0; i < maps.size(); i++)
      if (!paths[i].empty())
        maps[i].*file = i > 0 && paths[i] == paths[i - 1] ? maps[i - 1].*file : tool.read(paths[i]);
  };
  read(o.inputs, &MapFiles::normals);
  read(materials, &MapFiles::material);
  read(masks, &MapFiles::mask);
  if (!o.palette.empty()) o.quantize.palette = tool.read(o.palette);
  return maps;
}

void reserve_rgb(Tool& tool, const Options& o, std::vector<MapFiles>& maps) {
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

Json describe(const QuantizeResult& result) {
  const QuantizeStats& s = result.stats;
  Json materials = Json::array();
  for (const MaterialInterval& m : result.palette.materials)
    materials.push_back({{"id", m.id}, {"first", m.first}, {"count", m.count}});
  return {{"texels", s.texels},    {"normals", s.normals},   {"distinct_input_normals", s.distinct_input_normals},
          {"rms_deg", s.rms_deg},  {"mean_deg", s.mean_deg}, {"p95_deg", s.p95_deg},
          {"max_deg", s.max_deg},  {"lossless", s.lossless}, {"invalid_texels", s.invalid_texels},
          {"materials", materials}};
}

Json describe_maps(const Options& o, const Paths& outputs, const QuantizeResult& result) {
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

Json quantize(Tool& tool, Options& o) {
  check(o);
  const Paths outputs = output_paths(o);
  const FileType type = o.output_dir.empty() ? o.output.type() : o.output.type_of(outputs[0], "--extension");
  const bool with_palette = !o.output.palette_path.empty();
  const FileType palette_type = with_palette ? o.output.palette_type() : type;
  std::vector<MapFiles> maps = read_inputs(tool, o);
  if (!o.output_dir.empty()) tool.make_directory(o.output_dir);
  std::vector<FileRef> files;
  for (const std::string& path : outputs) files.push_back(tool.write(path));
  reserve_rgb(tool, o, maps);
  const FileRef palette_file = with_palette ? tool.write(o.output.palette_path) : FileRef();

  const auto write = [&](std::size_t i, const IndexedMap& map) {
    o.output.require_format(type, map.palette.normals.size(), outputs[i]);
    write_indexed_map(files[i], type, map);
  };
  const QuantizeResult result = quantize_normal_maps(std::move(maps), o.quantize, write, tool.progress());
  for (std::size_t i = 0; i < outputs.size(); i++)
    if (const auto said = result.maps[i].recorded_space; said && *said != result.palette.space)
      tool.warn("'" + o.inputs[i] + "' says that its normals are in " + name(*said) + " space; they are recorded as " +
                name(result.palette.space) + ", as asked for");
  if (with_palette) write_palette(palette_file, palette_type, result.palette);
  Json stats = describe(result);
  if (!o.output_dir.empty()) stats["maps"] = describe_maps(o, outputs, result);
  return stats;
}

void add_options(CLI::App& app, Options& o) {
  QuantizeOptions& q = o.quantize;
  app.add_option("NORMAL", o.inputs, "Normal map, or several that share the palette; '-' is standard input")
      ->required();
  o.output.add_to(app);
  app.get_option("--output")->required(false);
  app.add_option("--output-dir", o.output_dir,
                 "Instead of -o, where each map is written under its own stem; made, with those above it, if missing")
      ->type_name("DIR");
  add_choice<std::string>(app, "--extension", o.extension,
                          {{"exr", "exr"}, {"png", "png"}, {"ktx2", "ktx2"}, {"dds", "dds"}},
                          "Of the files in --output-dir (default exr)");
  auto* count = app.add_option("-n,--normals", q.normals, "Palette size (default 256)")
                    ->check(in_range(2, kMaxPaletteSize))
                    ->type_name("N");
  auto* target =
      app.add_option("--target-error", q.target_error_deg,
                     "Instead of -n: the smallest palette whose RMS angle, before dithering, is at most that")
          ->check(in_range(0.0, 180.0))
          ->type_name("DEG")
          ->excludes(count);
  const auto add_files = [&](const std::string& flag, Paths& files, const std::string& help) {
    app.add_option(flag, files,
                   help + ". Of several maps: given once for all, or repeated for each; {stem} is a map's stem")
        ->type_name("FILE")
        ->allow_extra_args(false)  // what follows is a map
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  add_files("--material", o.materials, "Material id of each texel: one channel, 8-bit");
  add_files("--mask", o.masks, "Texels where it is 0 do not shape the palette");
  add_choice<MaterialEncoding>(
      app, "--material-encoding", q.encoding,
      {{"split", MaterialEncoding::kSplit},
       {"alpha", MaterialEncoding::kAlpha},
       {"subcubes", MaterialEncoding::kSubcubes}},
      "How materials are quantized: each by itself with its share of the entries (default), or "
      "with the normals in the RGB cube, as its alpha or as subcubes of at most 4");
  app.add_option("--emit-rgb", o.rgb,
                 "With --material-encoding alpha or subcubes: write that image, a PNG, for other quantizers; of "
                 "several maps one each, by {stem} in its name")
      ->type_name("FILE");
  add_choice<Dither>(app, "--dither", q.dither,
                     {{"none", Dither::kNone}, {"diffusion", Dither::kDiffusion}, {"blue-noise", Dither::kBlueNoise}},
                     "Dithering (default none); never across a border of material or mask");
  app.add_option("--dither-amount", q.dither_amount, "How much of the error is dithered (default 1)")
      ->check(in_range(0.0, 1.0))
      ->type_name("A");
  auto* engine = add_choice<Engine>(
      app, "--engine", q.engine,
      {{"spherical", Engine::kSpherical}, {"median-cut", Engine::kMedianCut}, {"imagequant", Engine::kImagequant}},
      "How the palette is fitted (default spherical; median-cut is the paper's; imagequant holds at most 256)");
  app.add_option("--palette", o.palette,
                 "Use this palette instead of fitting one: an indexed normal map or a palette file; with alpha or "
                 "subcubes what another quantizer made of --emit-rgb")
      ->type_name("FILE")
      ->excludes(count)
      ->excludes(target)
      ->excludes(engine);
  add_choice<std::optional<NormalSpace>>(
      app, "--space", q.space, {{"tangent", NormalSpace::kTangent}, {"object", NormalSpace::kObject}},
      "Space of the normals, recorded in the output (default what --palette says, or NORMAL; otherwise tangent)");
  add_normal_coding(app, q.coding, true);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-quantize", "Normal maps, and materials, to indexed normal maps with a palette of normals.",
             "  burnish-quantize rocks_n.png -n 2048 -o rocks_q.exr\n"
             "  burnish-quantize rocks_n.png --target-error 0.5 --material ids.png -o rocks_q.exr\n"
             "  burnish-quantize a_n.png b_n.png --mask '{stem}_used.png' --output-dir quantized"});
  Options options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { return quantize(tool, options); });
}
