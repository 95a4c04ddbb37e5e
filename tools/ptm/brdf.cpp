// burnish-ptm brdf: the reflectance of a homogeneous surface to a BRDF PTM.
#include <filesystem>
#include <memory>
#include <optional>

#include "burnish/brdf/limited_brdf.h"
#include "burnish/brdf/measured/measured_brdf.h"
#include "burnish/brdf/model_brdf.h"
#include "burnish/core/error.h"
#include "burnish/ptm/brdf/brdf_error.h"
#include "burnish/ptm/brdf/fit_brdf.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/multiplied_out.h"
#include "burnish/ptm/round_ptm.h"
#include "ptm/ptm.h"

namespace burnish::cli {
namespace {

struct BrdfVerbOptions {
  std::string source;
  PtmOutput output;
  PtmType type = PtmType::kRgb;
  BrdfPtmSettings settings;
  double noise_factor = 0.9;
  std::optional<double> ceiling;
};

std::shared_ptr<const Brdf> read_source(Tool& tool, const BrdfVerbOptions& o) {
  auto brdf = is_model_source(o.source) ? model_brdf(o.source) : read_measured_brdf(tool.read(o.source));
  return o.ceiling ? std::make_shared<const LimitedBrdf>(std::move(brdf), *o.ceiling) : brdf;
}

// What the fit loses in each reading and type, of the coefficients themselves and where H is not shrunk.
Json readings(const Brdf& brdf, const Ptm& fitted, const BrdfPtmSettings& settings, const Progress& progress) {
  constexpr BrdfCoordinates kAll[] = {BrdfCoordinates::kHalfDifference, BrdfCoordinates::kLightView,
                                      BrdfCoordinates::kDifferenceHalf};
  Json out = Json::array();
  double done = 0;
  for (const BrdfCoordinates coordinates : kAll) {
    BrdfPtmSettings other = settings;
    other.coordinates = coordinates;
    const Ptm rgb = coordinates == settings.coordinates ? fitted : fit_brdf(brdf, other);
    for (const PtmType type : {PtmType::kRgb, PtmType::kLrgb}) {
      const BrdfPtmError error = brdf_error(type == PtmType::kRgb ? rgb : as_lrgb(rgb), coordinates, 1, brdf);
      out.push_back(
          {{"parameters", name(coordinates)}, {"type", name(type)}, {"rms", error.rms}, {"relative", error.relative}});
    }
    report_progress(progress, done += 1 / 3.0);
  }
  return out;
}

Json brdf(Tool& tool, const BrdfVerbOptions& o) {
  const bool to_stream = o.output.path == "-";
  if (o.output.path.ends_with(".ptm") || (to_stream && o.output.output_type == "ptm"))
    throw file_error(ErrorKind::kUnsupported, to_stream ? kStandardOutput : o.output.path,
                     "a BRDF PTM is written as textures behind a PREFIX/, or as .exr, not '.ptm' (--output)");
  const std::shared_ptr<const Brdf> brdf = read_source(tool, o);
  const PtmTarget target(tool, o.output);
  const bool with_readings = tool.app().count("--report") > 0;
  const Progress progress = tool.progress();
  const Ptm fitted = fit_brdf(*brdf, o.settings, part_of(progress, 0, with_readings ? 0.4 : 1));
  const auto normal = uniform_normal_matrix();
  const PtmInMemory map(o.type == PtmType::kRgb ? fitted : as_lrgb(fitted));
  Attributes also{{"parameters", name(o.settings.coordinates)},
                  {"noise_factor", std::vector<double>{o.noise_factor}},
                  {"source", std::filesystem::path(o.source).filename().string()}};
  if (o.ceiling) also.emplace_back("ceiling", std::vector<double>{*o.ceiling});
  target.write(map, normal, also);

  const Ptm stored = decoded(rounded(MultipliedOut(map), normal));
  const BrdfPtmError error = brdf_error(stored, o.settings.coordinates, o.noise_factor, *brdf);
  Json stats{{"width", fitted.width},          {"height", fitted.height},
             {"type", name(o.type)},           {"parameters", name(o.settings.coordinates)},
             {"noise_factor", o.noise_factor}, {"rms", error.rms},
             {"relative", error.relative}};
  if (with_readings) stats["readings"] = readings(*brdf, fitted, o.settings, part_of(progress, 0.4, 1));
  return stats;
}

}  // namespace

Verb add_brdf(Tool& tool) {
  const auto o = std::make_shared<BrdfVerbOptions>();
  CLI::App& verb =
      add_verb(tool, "brdf", "Fits a map to the reflectance of a homogeneous surface",
               "  burnish-ptm brdf ward:ax=0.2,ay=0.5,ks=1 -o ward/\n"
               "  burnish-ptm brdf paint.brdf -o paint/ --ceiling 1 --weights projected --report paint.json\n"
               "With --report the other parameters and types are fitted too, to compare them.");
  verb.add_option(
          "SOURCE", o->source,
          "ward:ax,ay,ks,kd, blinn-phong:ax,ay,n,ks,kd or banks:ks,kd, such as ward:ax=0.2,ks=1; or measurements: "
          ".binary (MERL), .brdf (Cornell), .mbsdf (NVIDIA)")
      ->required();
  o->output.add_to(verb);
  verb.remove_option(verb.get_option("--jpeg"));  // of .ptm files, which hold no BRDF PTM
  verb.get_option("--output")
      ->description(
          "What to write: six 8-bit textures and their ptm.json behind a PREFIX that ends in '/', or an .exr of the "
          "coefficients as floats; '-' is standard output");
  add_choice<PtmType>(verb, "--type", o->type, {{"rgb", PtmType::kRgb}, {"lrgb", PtmType::kLrgb}},
                      "A polynomial a colour (default), or one and a colour");
  add_choice<BrdfCoordinates>(
      verb, "--parameters", o->settings.coordinates,
      {{"half-difference", BrdfCoordinates::kHalfDifference}, {"light-view", BrdfCoordinates::kLightView}},
      "What the texture is addressed by, and the polynomial evaluated at: half vector and difference (default), or "
      "view and light");
  verb.add_option("--size", o->settings.size, "Texels along each side (default 64)")
      ->check(in_range(1, kLargestBrdfPtm))
      ->type_name("N");
  verb.add_option("--noise-factor", o->noise_factor,
                  "What shaders shrink the texture's coordinates by, which keeps them off its rim (default 0.9)")
      ->check(in_range(0.01, 1.0))
      ->type_name("F");
  add_choice<LightWeights>(
      verb, "--weights", o->settings.weights,
      {{"uniform", LightWeights::kUniform}, {"projected", LightWeights::kProjected}},
      "Of the fit over the lights of a texel: all alike (default), or as pixels of a sphere see them");
  verb.add_option("--ceiling", o->ceiling, "Take what is reflected above V for V; 1 is white (default: all as it is)")
      ->check(in_range(1e-6, 1e6))
      ->type_name("V");
  return {&verb, [o, &tool] { return brdf(tool, *o); }};
}

}  // namespace burnish::cli
