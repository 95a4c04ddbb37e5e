#include <filesystem>

#include "ptm/ptm.h"

namespace burnish::cli {

PtmInput open_input(Tool& tool, const std::string& path) {
  if (!path.ends_with('/') && !std::filesystem::is_directory(path)) {
    OpenPtm map = open_ptm(tool.read(path));
    const PtmType type = map.rows->shape().type;
    return {std::move(map.rows), map.format, type, {}};
  }
  const std::string prefix = path.ends_with('/') ? path : path + "/";
  PtmTextureFiles files;
  const auto names = ptm_texture_names();
  for (std::size_t i = 0; i < files.images.size(); i++) files.images[i] = tool.read(prefix + names[i]);
  files.json = tool.read(prefix + names.back());
  PtmTextures textures = read_ptm_textures(files);
  return {std::move(textures.rows), "textures", textures.made_of, Json::parse(textures.description.text)};
}

void add_input(CLI::App& verb, std::string& path) {
  verb.add_option("IN", path, "A .ptm, an .exr of coefficients or the PREFIX/ of textures; '-' is standard input")
      ->required();
}

}  // namespace burnish::cli
