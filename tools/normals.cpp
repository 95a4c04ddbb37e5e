// burnish-normals: displacement map to normal map.
#include "burnish/core/error.h"
#include "burnish/mesh/bake/baked_files.h"
#include "burnish/mesh/bake/displaced_normals.h"
#include "burnish/mesh/bake/gutter.h"
#include "burnish/normal/height_map.h"
#include "cli/mesh_input.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

const Words<Wrap> kWraps{
    {"fit", Wrap::kFit}, {"clamp", Wrap::kClamp}, {"repeat", Wrap::kRepeat}, {"mirror", Wrap::kMirror}};

// W[xH], each a length.
void parse_size(const std::string& text, HeightMapOptions& options) {
  const std::size_t x = text.find('x');
  options.size_u = parse_length("--size", text.substr(0, x));
  options.size_v = x == std::string::npos ? 0 : parse_length("--size", text.substr(x + 1));
  if (options.size_u <= 0 || (x != std::string::npos && options.size_v <= 0))
    throw CLI::ValidationError("--size", "expected positive lengths, got '" + text + "'");
}

// What --mesh adds.
struct MeshOptions {
  std::string file;
  std::string space;  // empty: object with a mesh, tangent without
  int padding = 16;

  void add_to(CLI::App& app, CLI::Option* size) {
    CLI::Option* mesh =
        app.add_option("--mesh", file,
                       "Displace this mesh through its texture coordinates, which lie in [0,1], and write object-space "
                       "normals; --height is in its units")
            ->type_name("FILE")
            ->excludes(size);
    add_choice<std::string>(app, "--space", space, {{"tangent", "tangent"}, {"object", "object"}},
                            "Space of the normals: object with --mesh, tangent without (the defaults)");
    app.add_option("--padding", padding, "With --mesh: gutter round each chart, in texels (default 16)")
        ->check(in_range(0, 65536))
        ->type_name("PX")
        ->needs(mesh);
  }

  void check() const {
    if (space == "object" && file.empty())
      throw Error(ErrorKind::kUsage, "--space object needs --mesh: without one there is no object");
    if (space == "tangent" && !file.empty())
      throw Error(ErrorKind::kUsage, "--space tangent goes without --mesh: in tangent space no mesh matters");
  }
};

Json report_of(const HeightMapStats& stats) {
  return {{"width", stats.width},
          {"height", stats.height},
          {"max_slope_deg", stats.max_slope_deg},
          {"mean_tilt_deg", stats.mean_tilt_deg},
          {"degenerate_texels", stats.degenerate_texels}};
}

Json report_of(const DisplacedNormals& map) {
  return {{"width", map.width},
          {"height", map.height},
          {"max_slope_deg", map.max_slope_deg},
          {"mean_tilt_deg", map.mean_tilt_deg},
          {"degenerate_texels", map.degenerate_texels},
          {"covered_texels", map.covered_texels},
          {"overlapped_texels", map.overlapped_texels}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-normals", "Displacement map to normal map, by a least-squares plane per texel.",
             "  burnish-normals rocks.tif -o rocks_n.png --height 10cm --size 2m --wrap repeat\n"
             "  burnish-normals bark.tif -o trunk_n.png --mesh trunk.obj --height 0.02 --mid-level 0.5"});
  CLI::App& app = tool.app();
  std::string input;
  ImageOutput output;
  HeightMapOptions options;
  NormalCoding coding;
  std::string mask;
  MeshOptions mesh;

  app.add_option("HEIGHT", input, "Displacement map; '-' is standard input")->required();
  output.add_to(app);
  app.add_option_function<std::string>(
         "--height", [&](const std::string& t) { options.height = parse_length("--height", t); },
         "Displacement of the value 1.0, in the units of --size: 2m, 10cm, 5mm or a number, which counts as metres "
         "beside them (default 1)")
      ->type_name("H");
  CLI::Option* size = app.add_option_function<std::string>(
                             "--size", [&](const std::string& t) { parse_size(t, options); },
                             "Extent of the whole map, as 2m or 2mx1m (default: one unit a texel)")
                          ->type_name("W[xH]");
  add_choice<int>(app, "--neighbors", options.neighbors, {{"4", 4}, {"8", 8}, {"24", 24}, {"48", 48}, {"80", 80}},
                  "Texels that the plane is fitted to (default 4)");
  add_choice<FitWeights>(app, "--weights", options.weights,
                         {{"uniform", FitWeights::kUniform}, {"gaussian", FitWeights::kGaussian}},
                         "Weights of the fit (default uniform; gaussian: sigma is half the radius)");
  std::optional<Wrap> wrap, wrap_u, wrap_v;
  const auto add_wrap = [&](const std::string& flag, std::optional<Wrap>& value, const std::string& help) {
    Words<std::optional<Wrap>> words;
    for (const auto& [word, w] : kWraps) words.emplace_back(word, w);
    add_choice<std::optional<Wrap>>(app, flag, value, words, help);
  };
  add_wrap("--wrap", wrap,
           "Beyond the map: fit (default) uses only texels that exist. With --mesh only texels of the same chart take "
           "part in a fit, whatever lies beyond the map");
  add_wrap("--wrap-u", wrap_u, "The same, for the left and right sides only");
  add_wrap("--wrap-v", wrap_v, "The same, for the top and bottom sides only");
  app.add_option("--mask", mask,
                 "Texels where it is 0 take no part and store (0,0,1); with --mesh the mesh's own normal")
      ->type_name("FILE");
  app.add_option("--mid-level", options.mid_level,
                 "Stored value that means no displacement (default 0); without --mesh no slope depends on it")
      ->type_name("M");
  app.add_option("--channel", options.channel,
                 "Channel of the heights, by name or by number from 0 (default the first)")
      ->type_name("C");
  mesh.add_to(app, size);
  add_normal_coding(app, coding, false);

  return tool.run(argc, argv, [&]() -> Json {
    options.wrap_u = wrap_u.value_or(wrap.value_or(Wrap::kFit));
    options.wrap_v = wrap_v.value_or(wrap.value_or(Wrap::kFit));
    mesh.check();
    const FileType type = output.type();
    const SampleType sample = output.sample();
    const FileRef height = tool.read(input);
    const FileRef mesh_file = mesh.file.empty() ? FileRef() : tool.read(mesh.file);
    if (!mask.empty()) options.mask = tool.read(mask);
    const NormalMapTarget target{tool.write(output.path), type, sample, coding};
    const auto warn_of_colours = [&] {
      tool.warn("'" + input + "': colour channels differ; the first was taken for the height (--channel chooses)");
    };
    if (mesh.file.empty()) {
      const HeightMapStats stats = convert_height_map(height, options, target, tool.progress());
      if (stats.colour_channels_differ) warn_of_colours();
      return report_of(stats);
    }
    require_encodable(coding, sample, target.file.name);
    const HeightField field = read_height_field(height, options);
    DisplacedNormals map = displaced_normals(read_mesh(tool, mesh_file), field, options, tool.progress());
    fill_gutter(gutter_sources(map.covered, mesh.padding), map.normals);
    write_baked_normals(target, NormalSpace::kObject, map.width, map.height, map.normals);
    if (field.colour_channels_differ) warn_of_colours();
    warn_of_overlaps(tool, mesh.file, map.overlapped_texels, "normal");
    return report_of(map);
  });
}
