// V of an option: a number for all texels, or the name of a map of them.
#pragma once

#include <optional>
#include <string>

#include "burnish/core/parameter.h"
#include "cli/tool.h"

namespace burnish::cli {

struct NumberOrMap {
  std::string flag, text;

  bool given() const { return !text.empty(); }
  std::optional<double> number() const;
  // kIo, naming the option, where the text is neither a number nor a file.
  FileRef map(Tool& tool) const;
  // Of what was given.
  ParameterSource source(Tool& tool) const;
};

}  // namespace burnish::cli
