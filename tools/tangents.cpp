// burnish-tangents: direction-of-anisotropy maps.
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/material/directions/convert_directions.h"
#include "cli/direction_options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

int quarters_of(double angle_deg) {
  const double quarters = std::fmod(angle_deg, 360) / 90;
  if (quarters == std::floor(quarters)) return int(quarters);
  throw Error(ErrorKind::kUsage,
              "rotate: expected a multiple of 90 degrees, which moves texels whole, got " + number_text(angle_deg));
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-tangents", "Direction-of-anisotropy maps: from one form to another, orthonormal to bump normals.",
             "  burnish-tangents brushed_flow.png --from flow --normal brushed_n.png -o brushed_t.exr -d float\n"
             "  burnish-tangents brushed_angle.tif --from angle --to khr -o brushed_anisotropy.png"});
  CLI::App& app = tool.app();
  std::string input, normals;
  ImageOutput output;
  DirectionSource from;
  DirectionTarget to;
  double rotate_deg = 0;
  DirectionOptions coding;

  app.add_option("DIRECTION", input, "Direction map; '-' is standard input. --y and --encoding hold for -o too")
      ->required();
  output.add_to(app);
  const Words<DirectionForm> forms{{"vector", DirectionForm::kVector},
                                   {"angle", DirectionForm::kAngle},
                                   {"flow", DirectionForm::kFlow},
                                   {"khr", DirectionForm::kKhr}};
  add_choice<DirectionForm>(app, "--from", from.coding.form, forms,
                            "Form of DIRECTION (default vector): xyz of any length; one channel, 0 to 1 being a turn "
                            "counter-clockwise from +u; xy of any length; KHR_materials_anisotropy");
  add_choice<DirectionForm>(app, "--to", to.coding.form, {forms[0], forms[1], forms[3]},
                            "Form of -o (default vector). khr keeps the strength of khr, and has 1 without");
  app.add_option("--normal", normals,
                 "Normal map in tangent space, to make directions orthogonal to: that of -o, of whose size it is")
      ->type_name("FILE");
  app.add_option("--rotate", rotate_deg, "Turn image and vectors counter-clockwise, by a multiple of 90")
      ->type_name("DEG");
  app.add_flag("--flip-u", from.turns.flip_u, "Flip image and vectors left to right, before they are rotated");
  app.add_flag("--flip-v", from.turns.flip_v, "Flip image and vectors upside down, before they are rotated");
  coding.add_to(app);

  return tool.run(argc, argv, [&]() -> Json {
    from.turns.quarters = quarters_of(rotate_deg);
    from.coding = coding.directions(from.coding.form);
    to.coding = coding.directions(to.coding.form);
    from.normal_coding = coding.normals();
    to.type = output.type();
    to.sample = output.sample();
    from.directions = tool.read(input);
    if (!normals.empty()) from.normals = tool.read(normals);
    to.file = tool.write(output.path);
    const DirectionStats stats = convert_directions(from, to);
    return {{"width", stats.width},
            {"height", stats.height},
            {"degenerate_texels", stats.degenerate_texels},
            {"invalid_normal_texels", stats.invalid_normal_texels},
            {"max_abs_n_dot_t", stats.max_abs_n_dot_t}};
  });
}
