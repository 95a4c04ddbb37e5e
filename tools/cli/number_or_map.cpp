#include "cli/number_or_map.h"

#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish::cli {

std::optional<double> NumberOrMap::number() const { return number_in<double>(text); }

FileRef NumberOrMap::map(Tool& tool) const {
  std::error_code unknown;
  if (text != "-" && !std::filesystem::exists(text, unknown) && !unknown)
    throw Error(ErrorKind::kIo, flag + ": expected a number or the file of a map, got '" + text + "'");
  return tool.read(text);
}

ParameterSource NumberOrMap::source(Tool& tool) const {
  if (const std::optional<double> value = number()) return {*value, {}};
  return {0, map(tool)};
}

}  // namespace burnish::cli
