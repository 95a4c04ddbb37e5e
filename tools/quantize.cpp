// burnish-quantize: normal map to indexed normal map.
#include "burnish/palette/quantize.h"

#include "burnish/core/error.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

Json describe(const QuantizeResult& result) {
  const QuantizeStats& s = result.stats;
  Json materials = Json::array();
  for (const MaterialInterval& m : result.map.palette.materials)
    materials.push_back({{"id", m.id}, {"first", m.first}, {"count", m.count}});
  return {{"texels", s.texels},    {"normals", s.normals},   {"distinct_input_normals", s.distinct_input_normals},
          {"rms_deg", s.rms_deg},  {"mean_deg", s.mean_deg}, {"p95_deg", s.p95_deg},
          {"max_deg", s.max_deg},  {"lossless", s.lossless}, {"invalid_texels", s.invalid_texels},
          {"materials", materials}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-quantize", "Normal map, and materials, to an indexed normal map with a palette of normals.",
             "  burnish-quantize rocks_n.png -n 2048 -o rocks_q.exr\n"
             "  burnish-quantize rocks_n.png --target-error 0.5 --material ids.png -o rocks_q.exr"});
  CLI::App& app = tool.app();
  std::string input, material, mask, palette;
  IndexedOutput output;
  QuantizeOptions options;

  app.add_option("NORMAL", input, "Normal map; '-' is standard input")->required();
  output.add_to(app);
  auto* count = app.add_option("-n,--normals", options.normals, "Palette size, 2 to 65536 (default 256)")
                    ->check(CLI::Range(2, kMaxPaletteSize))
                    ->type_name("N");
  auto* target =
      app.add_option("--target-error", options.target_error_deg,
                     "Instead of -n: the smallest palette whose RMS angle, before dithering, is at most that")
          ->check(CLI::Range(0.0, 180.0))
          ->type_name("DEG")
          ->excludes(count);
  app.add_option("--material", material, "Material id of each texel: one channel, 8-bit")->type_name("FILE");
  app.add_option("--mask", mask, "Texels where it is 0 do not shape the palette")->type_name("FILE");
  add_choice<Dither>(app, "--dither", options.dither,
                     {{"none", Dither::kNone}, {"diffusion", Dither::kDiffusion}, {"blue-noise", Dither::kBlueNoise}},
                     "Dithering (default none); never across a border of material or mask");
  app.add_option("--dither-amount", options.dither_amount, "How much of the error is dithered, 0 to 1 (default 1)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("A");
  auto* engine = add_choice<Engine>(
      app, "--engine", options.engine,
      {{"spherical", Engine::kSpherical}, {"median-cut", Engine::kMedianCut}, {"imagequant", Engine::kImagequant}},
      "How the palette is fitted (default spherical; median-cut is the paper's; imagequant holds at most 256)");
  app.add_option("--palette", palette,
                 "Use this palette, an indexed normal map or a palette file, instead of fitting one")
      ->type_name("FILE")
      ->excludes(count)
      ->excludes(target)
      ->excludes(engine);
  add_choice<std::optional<NormalSpace>>(
      app, "--space", options.space, {{"tangent", NormalSpace::kTangent}, {"object", NormalSpace::kObject}},
      "Space of the normals, recorded in the output (default tangent, or the palette's)");
  add_normal_coding(app, options.coding, true);

  return tool.run(argc, argv, [&]() -> Json {
    const FileType type = output.type();
    const bool with_palette = !output.palette_path.empty();
    const FileType palette_type = with_palette ? output.palette_type() : type;
    const FileRef normals = tool.read(input);
    if (!material.empty()) options.material = tool.read(material);
    if (!mask.empty()) options.mask = tool.read(mask);
    if (!palette.empty()) options.palette = tool.read(palette);
    const FileRef file = tool.write(output.path);
    const FileRef palette_file = with_palette ? tool.write(output.palette_path) : FileRef();
    const QuantizeResult result = quantize_normal_map(normals, options, tool.progress());
    output.require_format(type, result.map.palette.normals.size());
    write_indexed_map(file, type, result.map);
    if (with_palette) write_palette(palette_file, palette_type, result.map.palette);
    return describe(result);
  });
}
