// burnish-ptm: polynomial texture maps.
#include "ptm/ptm.h"

using namespace burnish;
using namespace burnish::cli;

int main(int argc, char** argv) {
  Tool tool({"burnish-ptm", "Polynomial texture maps: what a surface looks like under a light from anywhere.",
             "  burnish-ptm convert coin.ptm -o coin.exr\n"
             "  burnish-ptm --help, burnish-ptm convert --help"});
  tool.app().require_subcommand(1);
  const Verb verbs[] = {add_fit(tool), add_convert(tool)};
  return tool.run(argc, argv, [&]() -> Json {
    for (const Verb& verb : verbs)
      if (verb.app->parsed()) return verb.run();
    return {};
  });
}
