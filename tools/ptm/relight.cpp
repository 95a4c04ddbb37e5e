// burnish-ptm relight: a map under one light.
#include "burnish/ptm/relight.h"

#include <memory>

#include "burnish/core/number_text.h"
#include "ptm/ptm.h"

namespace burnish::cli {
namespace {

struct Options {
  std::string input;
  ImageOutput output;
  Vec3d light;
};

Vec3d parse_light(const std::string& text) {
  const std::size_t first = text.find(','), second = text.find(',', first + 1);
  if (first != std::string::npos && second != std::string::npos) {
    const auto x = number_in<double>(text.substr(0, first)),
               y = number_in<double>(text.substr(first + 1, second - first - 1)),
               z = number_in<double>(text.substr(second + 1));
    if (x && y && z && is_from_above({*x, *y, *z})) return {*x, *y, *z};
  }
  throw CLI::ValidationError(
      "--light",
      "expected a direction from above the surface, such as 0.3,-0.4,0.87 with z above 0, got '" + text + "'");
}

Json run(Tool& tool, const Options& o) {
  const FileType type = o.output.type();
  const SampleType sample = o.output.sample();
  const PtmInput map = open_input(tool, o.input);
  const PtmShape& shape = map.rows->shape();
  const RelightStats stats = relight(*map.rows, o.light, tool.write(o.output.path), type, sample, tool.progress());
  return {{"width", shape.width}, {"height", shape.height}, {"clipped_samples", stats.clipped_samples}};
}

}  // namespace

Verb add_relight(Tool& tool) {
  const auto o = std::make_shared<Options>();
  CLI::App& verb = add_verb(tool, "relight", "Shows a map under one light",
                            "  burnish-ptm relight coin.ptm --light 0.7,0.2,0.5 -o coin.png\n"
                            "Integers hold light up to 255 as [0,1], clipped to it; -d float holds all.");
  add_input(verb, o->input);
  o->output.add_to(verb);
  verb.add_option_function<std::string>(
          "--light", [o](const std::string& t) { o->light = parse_light(t); },
          "Towards the light, of any length: x to the right, y to the top, z to the viewer")
      ->type_name("X,Y,Z")
      ->required();
  return {&verb, [o, &tool] { return run(tool, *o); }};
}

}  // namespace burnish::cli
