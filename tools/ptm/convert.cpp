// burnish-ptm convert: one file of a polynomial texture map to another.
#include <memory>

#include "burnish/ptm/light_matrix.h"
#include "ptm/ptm.h"

namespace burnish::cli {

Verb add_convert(Tool& tool) {
  struct Options {
    std::string input;
    PtmOutput output;
  };
  const auto o = std::make_shared<Options>();
  CLI::App& verb = add_verb(tool, "convert", "Writes a map as another type of file",
                            "  burnish-ptm convert coin.ptm -o coin.exr\n"
                            "  burnish-ptm convert coin.exr -o coin/");
  add_input(verb, o->input);
  o->output.add_to(verb);
  return {&verb, [o, &tool]() -> Json {
            const PtmInput map = open_input(tool, o->input);
            const PtmShape& shape = map.rows->shape();
            PtmTarget(tool, o->output).write(*map.rows, uniform_normal_matrix(), map.members());
            return {{"width", shape.width}, {"height", shape.height}, {"type", name(shape.type)}};
          }};
}

}  // namespace burnish::cli
