#include "burnish/render/validate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "burnish/core/error.h"
#include "burnish/core/whole_file.h"
#include "burnish/render/frame.h"
#include "burnish/render/picture.h"
#include "burnish/render/validation_html.h"

namespace burnish {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity: the PSNR of equal pictures is null.
Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

std::string plain(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string json_text(const Scene& scene, const Validation& v) {
  Json checks = Json::array();
  for (const ToleranceCheck& c : v.checks)
    checks.push_back({{"name", c.name}, {"allowed", c.allowed}, {"got", finite_or_null(c.got)}, {"met", c.met}});
  const Json report{{"scene", std::filesystem::path(scene.name).filename().string()},
                    {"path", name(v.path)},
                    {"twin", name(RenderPath::kAnalytic)},
                    {"passed", v.passed()},
                    {"tolerances", checks},
                    {"heat_max", v.heat_max},
                    {"stats",
                     {{"psnr_db", finite_or_null(v.metrics.psnr_db)},
                      {"rmse", v.metrics.rmse},
                      {"max_abs", v.metrics.max_abs},
                      {"p95_abs", v.metrics.p95_abs},
                      {"pixels", v.metrics.pixels},
                      {"table_ms", v.table_ms}}}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Writes a picture and hands back the file's bytes.
std::string write_png(const FileRef& file, const Image& srgb) {
  write_image(file, FileType::kPng, SampleType::kUint8, srgb);
  return read_file(file);
}

}  // namespace

bool Validation::passed() const { return std::ranges::all_of(checks, &ToleranceCheck::met); }

std::string Validation::misses() const {
  std::string out;
  for (const ToleranceCheck& c : checks)
    if (!c.met)
      out += (out.empty() ? "" : "; ") + c.name + ": expected " +
             (c.name.starts_with("min") ? "at least " : "at most ") + plain(c.allowed) + ", got " + plain(c.got);
  return out;
}

std::vector<ToleranceCheck> check_tolerances(const Tolerances& tolerances, const ErrorMetrics& metrics) {
  std::vector<ToleranceCheck> out;
  if (const auto least = tolerances.min_psnr_db)
    out.push_back({"min_psnr_db", *least, metrics.psnr_db, metrics.psnr_db >= *least});
  const auto at_most = [&](const char* name, std::optional<double> most, double got) {
    if (most) out.push_back({name, *most, got, got <= *most});
  };
  at_most("max_abs", tolerances.max_abs, metrics.max_abs);
  at_most("max_rmse", tolerances.max_rmse, metrics.rmse);
  at_most("max_p95_abs", tolerances.max_p95_abs, metrics.p95_abs);
  return out;
}

void require_twin(RenderPath path) {
  if (path == RenderPath::kAnalytic)
    throw Error(ErrorKind::kUsage, "path 'analytic' is the twin itself; name the path to validate by --path");
}

Validation validate(const Scene& scene, const std::vector<ObjectAssets>& assets, RenderPath path,
                    const ValidationFiles& files, const Progress& progress) {
  require_twin(path);
  const int twin_samples = scene.validation.samples.value_or(scene.samples);
  const Frame frame = render_frame(scene, assets, {path, scene.samples, 0, {}},
                                   [&](double done) { report_progress(progress, 0.5 * done); });
  const Frame twin = render_frame(scene, assets, {RenderPath::kAnalytic, twin_samples, 0, {}},
                                  [&](double done) { report_progress(progress, 0.5 + 0.5 * done); });
  ByteImage counts = frame.covered;
  std::ranges::transform(counts.data, twin.covered.data, counts.data.begin(), std::bit_or<>());

  Validation v{path, compare(frame.colour, twin.colour, counts), frame.table_ms, 0, {}};
  if (v.metrics.pixels == 0)
    throw file_error(ErrorKind::kMalformed, scene.name, "no pixel shows an object, so there is nothing to validate");
  v.checks = check_tolerances(scene.validation.tolerances, v.metrics);
  v.heat_max = scene.validation.heat_max.value_or(v.metrics.max_abs);

  const double exposure = scene.image.exposure_stops;
  ValidationPictures pictures;
  pictures.picture = write_png(files.picture, srgb_picture(frame.colour, exposure));
  pictures.twin = write_png(files.twin, srgb_picture(twin.colour, exposure));
  const double full = v.heat_max > 0 ? v.heat_max : 1;  // equal pictures: black whatever the scale
  pictures.difference = write_png(files.difference, heat_picture(frame.colour, twin.colour, counts, full));
  write_file(files.json, json_text(scene, v));
  write_file(files.html, validation_html(scene, v, pictures));
  return v;
}

}  // namespace burnish
