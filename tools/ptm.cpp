// burnish-ptm: polynomial texture maps.
#include "ptm/ptm.h"

using namespace burnish;
using namespace burnish::cli;

int main(int argc, char** argv) {
  Tool tool({"burnish-ptm", "Polynomial texture maps: what a surface looks like under a light from anywhere.",
             "  burnish-ptm fit coin.lp -o coin.ptm\n"
             "  burnish-ptm relight coin.ptm --light 0.7,0.2,0.5 -o coin.png\n"
             "  burnish-ptm fit --help"});
  tool.app().require_subcommand(1);
  const Verb verbs[] = {add_fit(tool),     add_brdf(tool),    add_relight(tool),
                        add_normals(tool), add_convert(tool), add_info(tool)};
  return tool.run(argc, argv, [&]() -> Json {
    for (const Verb& verb : verbs)
      if (verb.app->parsed()) return verb.run();
    return {};
  });
}
