// burnish-ptm fit: photographs under known lights to a polynomial texture map.
#include <cmath>
#include <filesystem>
#include <memory>

#include "burnish/ptm/fit/fit_ptm.h"
#include "burnish/ptm/light_list.h"
#include "burnish/ptm/round_ptm.h"
#include "ptm/ptm.h"

namespace burnish::cli {
namespace {

struct FitVerbOptions {
  std::string lights;
  PtmOutput output;
  PtmFitOptions fit;
  int memory_mb = 1024;
};

Json fit(Tool& tool, FitVerbOptions& o) {
  const FileRef list = tool.read(o.lights);
  std::vector<FileRef> files;
  std::vector<Vec3d> lights;
  for (const LitPhoto& photo : read_light_list(list)) {
    tool.also_read(photo.file);
    files.push_back(photo.file);
    lights.push_back(photo.light);
  }
  const LightMatrix matrix = light_matrix(lights, o.fit.ridge, list.name);
  const PtmTarget target(tool, o.output);
  o.fit.memory = std::size_t(o.memory_mb) << 20;
  o.fit.directory = o.output.path == "-" ? "" : std::filesystem::path(o.output.path).parent_path().string();
  const bool with_error = tool.app().count("--report") > 0;
  const Progress progress = tool.progress();
  const Capture photos(std::move(files), o.fit.memory, o.fit.directory);
  PtmFit fitted = fit_ptm(photos, matrix, o.fit, part_of(progress, 0, with_error ? 0.6 : 1));
  // One after the other, so that memory holds one of them: coefficients, and what is stored of them.
  if (target.keeps_bytes()) fitted.rows = std::make_unique<PtmInBytes>(rounded(*fitted.rows, matrix.normal));
  target.write(*fitted.rows, matrix.normal);
  Json stats{
      {"images", photos.count()}, {"width", photos.width()}, {"height", photos.height()}, {"type", name(o.fit.type)}};
  if (with_error) {
    if (!target.keeps_bytes()) {
      fitted.rows.reset();
      fitted.rows = target.stored();
    }
    const double rmse = rms_error(*fitted.rows, photos, matrix, part_of(progress, 0.6, 1));
    stats["rmse"] = rmse;
    stats["psnr_db"] = rmse > 0 ? Json(20 * std::log10(255 / rmse)) : Json();
  }
  if (fitted.leave_one_out_rmse) stats["leave_one_out_rmse"] = *fitted.leave_one_out_rmse;
  return stats;
}

}  // namespace

Verb add_fit(Tool& tool) {
  const auto o = std::make_shared<FitVerbOptions>();
  CLI::App& verb = add_verb(tool, "fit", "Fits a map to photographs under known lights",
                            "  burnish-ptm fit coin.lp -o coin.ptm\n"
                            "  burnish-ptm fit coin.lp -o coin.exr --type rgb --reject-shadows --report coin.json\n"
                            "With --report the photographs are decoded twice, for the errors of what is stored.");
  verb.add_option("LIGHTS", o->lights,
                  "The list (.lp): the number of photographs, then a line each: file, x, y, z towards its light")
      ->required();
  o->output.add_to(verb);
  add_choice<PtmType>(verb, "--type", o->fit.type, {{"lrgb", PtmType::kLrgb}, {"rgb", PtmType::kRgb}},
                      "One polynomial of light and a colour (default), or a polynomial for each of red, green, blue");
  verb.add_option("--memory", o->memory_mb,
                  "Megabytes to work in (default 1024); what is more lies in a temporary file beside the output, or in "
                  "$TMPDIR")
      ->check(in_range(1, 1 << 24))
      ->type_name("MB");
  verb.add_flag("--reject-shadows", o->fit.reject_shadows,
                "Fit each texel without the photographs in which it lies in shadow or shines");
  verb.add_option("--ridge", o->fit.ridge,
                  "Penalty on squared coefficients, against lights that hardly determine them (default 0)")
      ->check(in_range(0.0, 1e9))
      ->type_name("LAMBDA");
  verb.add_flag("--leave-one-out", o->fit.leave_one_out,
                "Report how far each photograph is from what the others say of its light");
  return {&verb, [o, &tool] { return fit(tool, *o); }};
}

}  // namespace burnish::cli
