#include <filesystem>

#include "ptm/ptm.h"

namespace burnish::cli {

bool is_texture_prefix(const std::string& path) { return path.ends_with('/') || std::filesystem::is_directory(path); }

PtmInput open_input(const FileRef& file) {
  OpenPtm map = open_ptm(file);
  const PtmType type = map.rows->shape().type;
  return {std::move(map.rows), map.format, type, {}};
}

PtmInput open_input(Tool& tool, const std::string& path) {
  if (!is_texture_prefix(path)) return open_input(tool.read(path));
  const std::string prefix = path.ends_with('/') ? path : path + "/";
  PtmTextureFiles files;
  const auto names = ptm_texture_names();
  for (std::size_t i = 0; i < files.images.size(); i++) files.images[i] = tool.read(prefix + names[i]);
  files.json = tool.read(prefix + names.back());
  PtmTextures textures = read_ptm_textures(files);
  return {std::move(textures.rows), "textures", textures.made_of, Json::parse(textures.description.text)};
}

Attributes PtmInput::members() const {
  Attributes members{{"type", std::string(name(made_of))}};
  for (const auto& [key, value] : description.items())
    if (key != "type" && key != "width" && key != "height" && !key.starts_with("abc_") && !key.starts_with("def_"))
      members.emplace_back(key, JsonText{value.dump()});
  return members;
}

void add_input(CLI::App& verb, std::string& path) {
  verb.add_option("IN", path, "A .ptm, an .exr of coefficients or the PREFIX/ of textures; '-' is standard input")
      ->required();
}

}  // namespace burnish::cli
