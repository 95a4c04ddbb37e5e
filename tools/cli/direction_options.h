// How normal maps and direction maps that are used together are stored.
#pragma once

#include <optional>

#include "burnish/material/directions/direction_map.h"
#include "cli/options.h"

namespace burnish::cli {

// --y, --encoding and --channels, the first two for directions too, and --normal-y.
class DirectionOptions {
 public:
  void add_to(CLI::App& app);

  NormalCoding normals() const;
  DirectionCoding directions(DirectionForm form) const { return {form, all_.green, all_.encoding}; }

 private:
  NormalCoding all_;
  std::optional<GreenAxis> normals_green_;
};

}  // namespace burnish::cli
