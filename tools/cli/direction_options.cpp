#include "cli/direction_options.h"

namespace burnish::cli {

void DirectionOptions::add_to(CLI::App& app) {
  add_normal_coding(app, all_, true);
  add_choice<std::optional<GreenAxis>>(app, "--normal-y", normals_green_,
                                       {{"up", GreenAxis::kUp}, {"down", GreenAxis::kDown}},
                                       "Green of the normal map where it is not that of the directions: --y and "
                                       "--encoding hold for both")
      ->group("Normal map");
}

NormalCoding DirectionOptions::normals() const {
  NormalCoding coding = all_;
  coding.green = normals_green_.value_or(all_.green);
  return coding;
}

}  // namespace burnish::cli
