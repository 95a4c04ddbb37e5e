// burnish-ptm normals: where the surface of a map faces.
#include <memory>

#include "burnish/ptm/ptm_normals.h"
#include "ptm/ptm.h"

namespace burnish::cli {
namespace {

struct Options {
  std::string input;
  ImageOutput output;
  NormalCoding coding;
};

Json run(Tool& tool, const Options& o) {
  const FileType type = o.output.type();
  const SampleType sample = o.output.sample();
  const PtmInput map = open_input(tool, o.input);
  const PtmShape& shape = map.rows->shape();
  const PtmNormalStats stats =
      write_ptm_normals(*map.rows, {tool.write(o.output.path), type, sample, o.coding}, tool.progress());
  return {{"width", shape.width},
          {"height", shape.height},
          {"mean_tilt_deg", stats.mean_tilt_deg},
          {"flat_texels", stats.flat_texels},
          {"horizon_texels", stats.horizon_texels}};
}

}  // namespace

Verb add_normals(Tool& tool) {
  const auto o = std::make_shared<Options>();
  CLI::App& verb =
      add_verb(tool, "normals", "Writes the normals that a map's brightest lights stand for",
               "  burnish-ptm normals coin.ptm -o coin_n.png\n"
               "A normal is the direction of the light that its texel is brightest under, of an RGB map "
               "by the sum\nof its channels. Maxima beyond the disc of (u, v) lie on its edge, the horizon.");
  add_input(verb, o->input);
  o->output.add_to(verb);
  add_normal_coding(verb, o->coding, false);
  return {&verb, [o, &tool] { return run(tool, *o); }};
}

}  // namespace burnish::cli
