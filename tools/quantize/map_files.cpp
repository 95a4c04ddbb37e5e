// Which files go with which map.
#include <filesystem>

#include "quantize/quantize.h"

namespace burnish::cli {

std::string stem_of(const std::string& input) {
  if (input == "-") throw file_error(ErrorKind::kUsage, kStandardInput, "has no name to call other files by");
  return std::filesystem::path(input).stem().string();
}

Paths for_each_map(const QuantizeFiles& o, const std::string& flag, const Paths& given) {
  if (given.empty()) return Paths(o.inputs.size());
  if (const std::size_t maps = o.inputs.size(); given.size() != 1 && given.size() != maps)
    throw usage(flag + ": expected one file" + (maps > 1 ? " or " + std::to_string(maps) : "") + ", got " +
                std::to_string(given.size()));
  Paths paths;
  for (std::size_t i = 0; i < o.inputs.size(); i++) {
    std::string path = given[given.size() == 1 ? 0 : i];
    for (std::size_t at = 0; (at = path.find(kStem, at)) != std::string::npos;) {
      const std::string stem = stem_of(o.inputs[i]);
      path.replace(at, kStem.size(), stem);
      at += stem.size();
    }
    paths.push_back(path);
  }
  return paths;
}

std::vector<MapFiles> read_maps(Tool& tool, const QuantizeFiles& o) {
  const Paths materials = for_each_map(o, "--material", o.materials), masks = for_each_map(o, "--mask", o.masks);
  std::vector<MapFiles> maps(o.inputs.size());
  const auto read = [&](const Paths& paths, FileRef MapFiles::*file) {
    for (std::size_t i = 0; i < maps.size(); i++)
      if (!paths[i].empty())
        maps[i].*file = i > 0 && paths[i] == paths[i - 1] ? maps[i - 1].*file : tool.read(paths[i]);
  };
  read(o.inputs, &MapFiles::normals);
  read(materials, &MapFiles::material);
  read(masks, &MapFiles::mask);
  return maps;
}

}  // namespace burnish::cli
