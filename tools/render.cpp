// burnish-render: the reference renderer, and the check of a path against its analytic twin.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/wording.h"
#include "burnish/render/frame.h"
#include "burnish/render/frame_names.h"
#include "burnish/render/picture.h"
#include "burnish/render/validate.h"
#include "cli/mesh_input.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

struct Options {
  std::string scene, path, aovs, report_dir;
  ImageOutput output;
  int frames = 1;
  bool validate = false;
};

Error usage(const std::string& message) { return Error(ErrorKind::kUsage, message); }

// What CLI11 cannot say: which options go together.
void check(const Options& o, const CLI::App& app) {
  if (!o.validate) {
    if (o.output.path.empty()) throw usage("--output is required, or --validate with --report-dir");
    if (!o.report_dir.empty()) throw usage("--report-dir goes with --validate");
    return;
  }
  if (o.report_dir.empty()) throw usage("--validate needs --report-dir");
  for (const char* flag : {"--output", "--format", "--output-type", "--frames", "--aov"})
    if (app.get_option(flag)->count()) throw usage(std::string(flag) + " does not go with --validate");
}

RenderPath path_of(const Options& o) {
  try {
    return render_path(o.path, ErrorKind::kUsage);
  } catch (const Error& error) {
    throw Error(error.kind(), std::string("--path: ") + error.what());
  }
}

Scene read_inputs(Tool& tool, const Options& o) {
  Scene scene = read_scene(tool.read(o.scene));
  if (!o.path.empty()) scene.path = path_of(o);
  for (const std::string& file : scene.files()) tool.also_read(file);
  return scene;
}

std::vector<ObjectAssets> load(Tool& tool, Scene& scene) {
  std::vector<ObjectAssets> assets = load_assets(scene);
  for (std::size_t i = 0; i < assets.size(); i++) {
    warn_of_dropped_faces(tool, scene.objects[i].mesh, assets[i].dropped_faces);
    if (const std::size_t n = assets[i].invalid_texels)
      tool.warn("'" + scene.objects[i].normal_map + "': " + counted(n, "texel") + (n == 1 ? " holds" : " hold") +
                " no direction and " + (n == 1 ? "counts" : "count") + " as (0,0,1)");
  }
  for (const Material& material : scene.materials)
    for (const LightingModel& term : material.terms)
      if (const auto* environment = std::get_if<Environment>(&term); environment && environment->panorama->integer())
        tool.warn("'" + environment->file +
                  "' holds integers, which are taken as linear light; a picture in sRGB must be made linear first");
  return assets;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

Json render(Tool& tool, const Options& o) {
  const FileType type = o.output.type();
  const SampleType sample = o.output.sample();
  const std::vector<Aov> aovs = o.aovs.empty() ? std::vector<Aov>{} : parse_aovs(o.aovs);
  const FrameNames names(o.output.path, o.frames, aovs);
  Scene scene = read_inputs(tool, o);
  std::vector<std::vector<FileRef>> files(o.frames);
  for (int i = 0; i < o.frames; i++)
    for (const std::string& file : names.of_frame(i)) files[i].push_back(tool.write(file));

  const std::vector<ObjectAssets> assets = load(tool, scene);
  const Progress progress = tool.progress();
  std::vector<double> table_ms;
  for (int i = 0; i < o.frames; i++) {
    const FrameSettings settings{scene.path, scene.samples, 2 * kPi * i / o.frames, aovs};
    const Frame frame =
        render_frame(scene, assets, settings, [&](double done) { report_progress(progress, (i + done) / o.frames); });
    table_ms.push_back(frame.table_ms);
    write_image(files[i][0], type, sample,
                type == FileType::kPng ? srgb_picture(frame.colour, scene.image.exposure_stops) : frame.colour);
    for (std::size_t a = 0; a < aovs.size(); a++)
      write_image(files[i][a + 1], FileType::kExr, SampleType::kFloat, frame.aovs[a]);
  }
  Json stats{
      {"path", name(scene.path)}, {"width", scene.image.width}, {"height", scene.image.height}, {"frames", o.frames}};
  if (scene.path != RenderPath::kAnalytic) stats["table_ms"] = median(std::move(table_ms));
  return stats;
}

// JSON has no infinity: the PSNR of equal pictures is null.
Json decibels(double psnr_db) { return std::isfinite(psnr_db) ? Json(psnr_db) : Json(); }

Json validate(Tool& tool, const Options& o) {
  Scene scene = read_inputs(tool, o);
  require_twin(scene.path);
  const std::filesystem::path dir(o.report_dir);
  tool.make_directory(o.report_dir);
  const auto file = [&](const std::string& leaf) { return tool.write((dir / leaf).string()); };
  ValidationFiles files;
  files.picture = file(name(scene.path) + std::string(".png"));
  files.twin = file("analytic.png");
  files.difference = file("difference.png");
  files.json = file("report.json");
  files.html = file("report.html");
  const Validation v = burnish::validate(scene, load(tool, scene), scene.path, files, tool.progress());
  if (!v.passed()) tool.threshold_missed("'" + scene.name + "': " + v.misses());
  return {{"path", name(v.path)},
          {"width", scene.image.width},
          {"height", scene.image.height},
          {"pixels", v.metrics.pixels},
          {"psnr_db", decibels(v.metrics.psnr_db)},
          {"rmse", v.metrics.rmse},
          {"max_abs", v.metrics.max_abs},
          {"p95_abs", v.metrics.p95_abs},
          {"passed", v.passed()},
          {"table_ms", v.table_ms}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-render", "Reference renderer: a scene to a picture, or a path held against its analytic twin.",
             "  burnish-render rocks.toml -o rocks.png\n"
             "  burnish-render rocks.toml --frames 36 -o turn/rocks_%04d.png\n"
             "  burnish-render --validate rocks.toml --report-dir report"});
  CLI::App& app = tool.app();
  Options o;
  o.output.as = {"a picture", {FileType::kPng, FileType::kExr}};
  app.add_option("SCENE", o.scene, "Scene in TOML (keys: samples/README.md); '-' is standard input")->required();
  o.output.add_to(app);
  app.get_option("--output")
      ->required(false)
      ->description(
          "Picture to write: sRGB in PNG, linear in EXR; '-' is standard output; of several frames a pattern "
          "with %d or %04d");
  app.add_option("--path", o.path,
                 "Path to render by, instead of the scene's: analytic, palette, ward and others (samples/README.md)")
      ->type_name("NAME");
  app.add_option("--frames", o.frames, "Pictures of a full turn of the lights, numbered from 0 (default 1)")
      ->check(in_range(1, kMostFrameFiles))
      ->type_name("N");
  app.add_option("--aov", o.aovs,
                 "Auxiliary images beside the picture, as OUT.NAME.exr: normal, position, uv, depth, index, "
                 "material, level")
      ->type_name("NAME,…");
  app.add_flag("--validate", o.validate,
               "Hold the scene's path against its analytic twin; exit 10 if a tolerance is not met");
  app.add_option("--report-dir", o.report_dir,
                 "Where --validate writes PATH.png, analytic.png, difference.png, report.json and "
                 "report.html; made, with those above it, if missing")
      ->type_name("DIR");

  return tool.run(argc, argv, [&]() -> Json {
    check(o, app);
    return o.validate ? validate(tool, o) : render(tool, o);
  });
}
