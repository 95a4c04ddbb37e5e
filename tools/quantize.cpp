// burnish-quantize: normal maps to indexed normal maps with one palette.
#include "quantize/quantize.h"

using namespace burnish;
using namespace burnish::cli;

namespace burnish::cli {

Json describe(const QuantizeStats& s, const Palette& palette) {
  Json materials = Json::array();
  for (const MaterialInterval& m : palette.materials)
    materials.push_back({{"id", m.id}, {"first", m.first}, {"count", m.count}});
  return {{"texels", s.texels},    {"normals", s.normals},   {"distinct_input_normals", s.distinct_input_normals},
          {"rms_deg", s.rms_deg},  {"mean_deg", s.mean_deg}, {"p95_deg", s.p95_deg},
          {"max_deg", s.max_deg},  {"lossless", s.lossless}, {"invalid_texels", s.invalid_texels},
          {"materials", materials}};
}

void warn_of_space(Tool& tool, const std::string& file, std::optional<NormalSpace> said, NormalSpace recorded) {
  if (said && *said != recorded)
    tool.warn("'" + file + "' says that its normals are in " + name(*said) + " space; they are recorded as " +
              name(recorded) + ", as asked for");
}

}  // namespace burnish::cli

namespace {

void add_options(CLI::App& app, QuantizeFiles& o) {
  QuantizeOptions& q = o.quantize;
  app.add_option("NORMAL", o.inputs, "Normal map, or several that share the palette; '-' is standard input");
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
  const char* histograms = "Histograms";
  app.add_option("--histogram-output", o.histogram_output,
                 "Instead of -o: write how often the maps have which normals, for --histograms")
      ->type_name("FILE")
      ->group(histograms);
  app.add_option("--histograms", o.histograms,
                 "Instead of NORMAL: fit the palette of all maps that these were written for, and write it to "
                 "--palette-output")
      ->type_name("FILE")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(histograms);
}

Json run(Tool& tool, QuantizeFiles& o) {
  if (!o.histograms.empty()) return fit_to_histograms(tool, o);
  if (o.inputs.empty()) throw usage("NORMAL is required, or --histograms");
  return o.histogram_output.empty() ? quantize_maps(tool, o) : write_histogram_of(tool, o);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-quantize", "Normal maps, and materials, to indexed normal maps with a palette of normals.",
             "  burnish-quantize rocks_n.png -n 2048 -o rocks_q.exr\n"
             "  burnish-quantize rocks_n.png --target-error 0.5 --material ids.png -o rocks_q.exr\n"
             "  burnish-quantize a_n.png b_n.png --mask '{stem}_used.png' --output-dir quantized\n"
             "  burnish-quantize a_n.png --histogram-output a.histogram\n"
             "  burnish-quantize --histograms a.histogram b.histogram -n 2048 --palette-output shared.exr"});
  QuantizeFiles options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { return run(tool, options); });
}
