#include "burnish/material/material_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/image_chain.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

const std::string kModel = "burnish:model", kAlpha = "burnish:alpha", kScale = "burnish:scale", kBias = "burnish:bias";

constexpr MaterialModel kModels[] = {MaterialModel::kBanks, MaterialModel::kBlinnPhong, MaterialModel::kWard};
const std::pair<FileType, std::string> kTypes[] = {
    {FileType::kExr, ".exr"}, {FileType::kPng, ".png"}, {FileType::kTiff, ".tif"}};

// What the fourth channel of a texture holds; empty where there is none.
std::string meaning_of_alpha(MaterialModel model, char which) {
  if (model == MaterialModel::kWard) return which == 'n' ? "k_s/(4 pi alpha_x alpha_y)" : "";
  if (which == 't') return "k_s";
  return model == MaterialModel::kBlinnPhong && which == 'b' ? "N" : "";
}

Attributes attributes_of(const MaterialTexture& texture, MaterialModel model, char which) {
  const auto numbers = [&](const std::array<float, 4>& of) {
    return std::vector<double>(of.begin(), of.begin() + texture.channels());
  };
  Attributes all{{kModel, name(model)}, {kScale, numbers(texture.scale)}, {kBias, numbers(texture.bias)}};
  if (const std::string alpha = meaning_of_alpha(model, which); !alpha.empty()) all.emplace_back(kAlpha, alpha);
  return all;
}

MaterialModel model_of(const ImageReader& reader) {
  const std::string text = reader.text(kModel).value_or("nothing");
  for (const MaterialModel model : kModels)
    if (text == name(model)) return model;
  throw file_error(
      ErrorKind::kMalformed, reader.name(),
      "expected a material texture, whose " + kModel + " is banks, blinn-phong or ward, got '" + excerpt(text) + "'");
}

std::array<float, 4> numbers_of(const ImageReader& reader, const std::string& attribute, float otherwise) {
  std::array<float, 4> out;
  out.fill(otherwise);
  const auto numbers = reader.numbers(attribute);
  if (!numbers) return out;
  if (int(numbers->size()) != reader.channels() ||
      !std::ranges::all_of(*numbers, [](double v) { return std::isfinite(v); }))
    throw file_error(ErrorKind::kMalformed, reader.name(),
                     "expected " + attribute + " of " + counted(std::size_t(reader.channels()), "number") + ", got " +
                         std::to_string(numbers->size()));
  std::ranges::transform(*numbers, out.begin(), [](double v) { return float(v); });
  return out;
}

MaterialTexture read_texture(ImageReader& reader, MaterialModel model, char which) {
  const std::string alpha = meaning_of_alpha(model, which);
  if (const int channels = alpha.empty() ? 3 : 4; reader.channels() != channels)
    throw file_error(ErrorKind::kMalformed, reader.name(),
                     "expected " + counted(std::size_t(channels), "channel") + " of " + name(model) + "'s " + which +
                         ", got " + std::to_string(reader.channels()));
  if (const std::string text = reader.text(kAlpha).value_or(""); text != alpha)
    throw file_error(
        ErrorKind::kMalformed, reader.name(),
        "expected " + kAlpha + " '" + alpha + "' of " + name(model) + "'s " + which + ", got '" + excerpt(text) + "'");
  MaterialTexture texture;
  texture.scale = numbers_of(reader, kScale, 1);
  texture.bias = numbers_of(reader, kBias, 0);
  texture.levels = read_image_chain(reader);
  for (const Image& level : texture.levels)
    require_samples(
        reader.name(), level.data, level.width, level.channels, 0, level.channels,
        [](float v) { return std::isfinite(v); }, "finite values");
  return texture;
}

}  // namespace

const char* name(MaterialModel model) {
  switch (model) {
    case MaterialModel::kBanks:
      return "banks";
    case MaterialModel::kBlinnPhong:
      return "blinn-phong";
    default:
      return "ward";
  }
}

std::string material_file(const std::string& prefix, char which) {
  std::vector<std::string> found;
  for (const auto& [type, extension] : kTypes)
    if (const std::string file = material_file(prefix, which, type); std::filesystem::exists(file))
      found.push_back(file);
  const std::string all = prefix + "_" + which + ".exr, .png or .tif";
  if (found.empty()) throw file_error(ErrorKind::kIo, all, "there is none");
  if (found.size() > 1)
    throw file_error(ErrorKind::kUsage, all,
                     "expected one of them, got '" + joined(found, "' and '") + "': remove or rename one of them");
  return found.front();
}

std::string material_file(const std::string& prefix, char which, FileType type) {
  return prefix + "_" + which + std::ranges::find(kTypes, type, &std::pair<FileType, std::string>::first)->second;
}

void write_material_textures(const MaterialTextures& textures, const FileRef& t, const FileRef& b, const FileRef& n,
                             FileType type, SampleType sample) {
  const auto write = [&](const FileRef& file, const MaterialTexture& texture, char which) {
    const Attributes attributes = attributes_of(texture, textures.model, which);
    if (type == FileType::kExr) return write_image_chain(file, sample, texture.levels, attributes);
    if (texture.levels.size() > 1)
      throw file_error(ErrorKind::kUnsupported, file.name,
                       std::string("material textures of several levels are written as EXR, not ") + name(type));
    write_image(file, type, sample, texture.levels[0], attributes);
  };
  write(t, textures.t, 't');
  write(b, textures.b, 'b');
  write(n, textures.n, 'n');
}

MaterialTextures read_material_textures(const FileRef& t, const FileRef& b, const FileRef& n) {
  ImageReader first(t);
  MaterialTextures textures;
  textures.model = model_of(first);
  textures.t = read_texture(first, textures.model, 't');
  const auto read = [&](const FileRef& file, char which) {
    ImageReader reader(file);
    const std::string of = "'" + t.name + "'";
    if (const MaterialModel model = model_of(reader); model != textures.model)
      throw file_error(
          ErrorKind::kMalformed, file.name,
          std::string("expected the model ") + name(textures.model) + " as in " + of + ", got " + name(model));
    reader.require_size(textures.width(), textures.height(), of);
    MaterialTexture texture = read_texture(reader, textures.model, which);
    if (texture.levels.size() != textures.t.levels.size())
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected " + counted(textures.t.levels.size(), "level") + " as in " + of + ", got " +
                           std::to_string(texture.levels.size()));
    return texture;
  };
  textures.b = read(b, 'b');
  textures.n = read(n, 'n');
  return textures;
}

}  // namespace burnish
