// burnish-material: material textures of a bumpy surface that reflects anisotropically.
#include <cmath>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/material/bake_material.h"
#include "cli/direction_options.h"
#include "cli/number_or_map.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

struct Options {
  std::string prefix, directions, normals;
  FileType type = FileType::kPng;
  std::optional<SampleType> sample;
  NumberOrMap alpha_x{"--alpha-x", ""}, alpha_y{"--alpha-y", ""}, k_s{"--ks", ""}, exponent{"--exponent", ""},
      angle{"--angle", ""};
  DirectionOptions coding;
  MaterialSource source;
  BakeOptions bake;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("-o,--output", o.prefix, "Write PREFIX_t, PREFIX_b and PREFIX_n")->required()->type_name("PREFIX");
  add_choice<FileType>(app, "--extension", o.type,
                       {{"png", FileType::kPng}, {"tif", FileType::kTiff}, {"exr", FileType::kExr}},
                       "Of the outputs (default png)");
  add_choice<std::optional<SampleType>>(app, "-d,--format", o.sample,
                                        {{"uint8", SampleType::kUint8},
                                         {"uint16", SampleType::kUint16},
                                         {"half", SampleType::kHalf},
                                         {"float", SampleType::kFloat}},
                                        "Samples; default by the file's type");
  add_choice<MaterialModel>(
      app, "--model", o.source.model,
      {{"banks", MaterialModel::kBanks}, {"blinn-phong", MaterialModel::kBlinnPhong}, {"ward", MaterialModel::kWard}},
      "Reflectance model")
      ->required();
  const auto add_value = [&](NumberOrMap& value, const std::string& help) {
    return app.add_option(value.flag, value.text, help)->type_name("V");
  };
  add_value(o.alpha_x,
            "Width of the lobe along the direction of anisotropy, above 0: a number, or a map's first channel, with "
            "integers as [0,1]. Not of banks, required otherwise");
  add_value(o.alpha_y, "The same across it");
  add_value(o.k_s, "Specular coefficient, a number or a map (default 1)");
  add_value(o.exponent, "Exponent N of blinn-phong, a number or a map (default 32)");
  CLI::Option* angle =
      add_value(o.angle,
                "Direction of anisotropy in degrees counter-clockwise from +u (default 0), or a map in "
                "which 0 to 1 is a turn");
  app.add_option("--direction", o.directions,
                 "Direction of anisotropy as a map of vectors of any length, such as of burnish-tangents --to vector")
      ->type_name("FILE")
      ->excludes(angle);
  app.add_option("--normal", o.normals, "Bump normals in tangent space (default (0,0,1))")->type_name("FILE");
  add_choice<VectorRange>(
      app, "--encode", o.bake.range, {{"combiner", VectorRange::kCombiner}, {"float", VectorRange::kFloat}},
      "combiner (default): vectors divided by alpha are scaled by --alpha-min, and all are biased to [0,1]; float: "
      "vectors as they are, in half or float samples");
  add_choice<double>(app, "--alpha-min", o.bake.alpha_min, {{"0.25", 0.25}, {"0.5", 0.5}, {"1", 1}},
                     "Least alpha of --encode combiner (default 0.25)");
  app.add_flag("--clamp-alpha", o.bake.clamp_alpha, "Raise what is below --alpha-min to it, instead of an error");
  o.coding.add_to(app);
}

// Options that others rule out or ask for.
void check(Tool& tool, const Options& o) {
  const MaterialModel model = o.source.model;
  if (o.prefix == "-")
    throw Error(ErrorKind::kUsage,
                "--output: expected a prefix of three files' names, got '-': standard output takes one");
  const bool divided = model != MaterialModel::kBanks;
  for (const NumberOrMap* alpha : {&o.alpha_x, &o.alpha_y}) {
    if (divided && !alpha->given())
      throw Error(ErrorKind::kUsage, alpha->flag + " is required by --model " + name(model));
    if (!divided && alpha->given()) tool.warn(alpha->flag + " is not used: banks has none");
  }
  if (model != MaterialModel::kBlinnPhong && o.exponent.given())
    tool.warn(o.exponent.flag + " is not used: " + name(model) + " has none");
  if (o.bake.range == VectorRange::kFloat)
    for (const char* flag : {"--alpha-min", "--clamp-alpha"})
      if (tool.app().count(flag))
        throw Error(ErrorKind::kUsage,
                    std::string(flag) + " goes with --encode combiner: float has room for any alpha");
}

void read_inputs(Tool& tool, Options& o) {
  MaterialSource& source = o.source;
  const auto take = [&](const NumberOrMap& value, ParameterSource& to) {
    if (value.given()) to = value.source(tool);
  };
  if (source.model != MaterialModel::kBanks) take(o.alpha_x, source.alpha_x), take(o.alpha_y, source.alpha_y);
  take(o.k_s, source.k_s);
  if (source.model == MaterialModel::kBlinnPhong) take(o.exponent, source.exponent);
  source.direction_coding = o.coding.directions(DirectionForm::kVector);
  if (const std::optional<double> angle_deg = o.angle.number()) {
    if (!std::isfinite(*angle_deg)) throw Error(ErrorKind::kUsage, "angle: expected a number, got " + o.angle.text);
    source.angle_rad = radians(*angle_deg);
  } else if (o.angle.given()) {
    source.directions = o.angle.map(tool);
    source.direction_coding.form = DirectionForm::kAngle;
  }
  if (!o.directions.empty()) source.directions = tool.read(o.directions);
  if (!o.normals.empty()) source.normals = tool.read(o.normals);
  source.normal_coding = o.coding.normals();
}

Json bake(Tool& tool, Options& o) {
  check(tool, o);
  const auto file = [&](char which) { return material_file(o.prefix, which, o.type); };
  o.bake.sample = o.sample.value_or(default_sample_type(o.type));
  require_can_hold(o.type, o.bake.sample, file('t'));
  read_inputs(tool, o);
  const FileRef t = tool.write(file('t')), b = tool.write(file('b')), n = tool.write(file('n'));
  const BakeStats stats = bake_material(o.source, o.bake, {t, b, n, o.type});
  return {{"width", stats.width},
          {"height", stats.height},
          {"scale", stats.scale},
          {"clamped_texels", stats.clamped_texels},
          {"degenerate_texels", stats.degenerate_texels},
          {"invalid_normal_texels", stats.invalid_normal_texels},
          {"max_component", stats.max_component}};
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-material", "Material textures of a bumpy surface that reflects anisotropically.",
             "  burnish-material --model ward --alpha-x 0.3 --alpha-y 0.8 --normal n.png --angle 30 -o brushed\n"
             "  burnish-material --model ward --alpha-x ax.exr --alpha-y ay.exr --direction t.exr --normal n.png \\\n"
             "    --encode float --extension exr -o scratched"});
  Options options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { return bake(tool, options); });
}
