#include "burnish/material/material_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

const std::string kModel = "burnish:model", kAlpha = "burnish:alpha", kScale = "burnish:scale", kBias = "burnish:bias";

constexpr char kNames[] = "tbn";
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
    return std::vector<double>(of.begin(), of.begin() + channels_of(model, which));
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

// All but the levels.
MaterialTexture read_head(const ImageReader& reader, MaterialModel model, char which) {
  const std::string alpha = meaning_of_alpha(model, which);
  if (const int channels = channels_of(model, which); reader.channels() != channels)
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
  return texture;
}

void require_finite(const ImageReader& reader, const Image& level, int first_row) {
  require_samples(
      reader.name(), level.data, level.width, level.channels, 0, level.channels,
      [](float v) { return std::isfinite(v); }, "finite values", first_row);
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

int channels_of(MaterialModel model, char which) { return meaning_of_alpha(model, which).empty() ? 3 : 4; }

MaterialTexturesWriter::MaterialTexturesWriter(const MaterialTextures& like, int width, int height, int levels,
                                               const FileRef& t, const FileRef& b, const FileRef& n, FileType type,
                                               SampleType sample) {
  const FileRef* const files[] = {&t, &b, &n};
  for (std::size_t i = 0; i < 3; i++) {
    const int channels = channels_of(like.model, kNames[i]);
    const Attributes attributes = attributes_of(*like.all()[i], like.model, kNames[i]);
    if (type == FileType::kExr) {
      chains_.emplace_back(*files[i], sample, width, height, channels, levels, attributes);
      continue;
    }
    if (levels > 1)
      throw file_error(ErrorKind::kUnsupported, files[i]->name,
                       std::string("material textures of several levels are written as EXR, not ") + name(type));
    images_.emplace_back(*files[i], type, sample, width, height, channels, attributes);
  }
}

void MaterialTexturesWriter::write_rows(int level, const Image& t, const Image& b, const Image& n) {
  const Image* const rows[] = {&t, &b, &n};
  for (std::size_t i = 0; i < 3; i++) {
    if (chains_.empty()) images_[i].write_rows(rows[i]->height, rows[i]->data.data());
    else chains_[i].write_rows(level, rows[i]->height, rows[i]->data.data());
  }
}

void MaterialTexturesWriter::close() {
  for (ImageChainWriter& chain : chains_) chain.close();
  for (ImageWriter& image : images_) image.close();
}

void write_material_textures(const MaterialTextures& textures, const FileRef& t, const FileRef& b, const FileRef& n,
                             FileType type, SampleType sample) {
  const std::size_t levels = textures.t.levels.size();
  MaterialTexturesWriter writer(textures, textures.width(), textures.height(), int(levels), t, b, n, type, sample);
  for (std::size_t l = 0; l < levels; l++)
    writer.write_rows(int(l), textures.t.levels[l], textures.b.levels[l], textures.n.levels[l]);
  writer.close();
}

MaterialTexturesReader::MaterialTexturesReader(const FileRef& t, const FileRef& b, const FileRef& n) {
  readers_.emplace_back(t);
  like_.model = model_of(readers_[0]);
  like_.t = read_head(readers_[0], like_.model, 't');
  const std::string of = "'" + t.name + "'";
  const int levels = readers_[0].levels();
  const auto open = [&](const FileRef& file, char which) {
    ImageReader& reader = readers_.emplace_back(file);
    if (const MaterialModel other = model_of(reader); other != model())
      throw file_error(ErrorKind::kMalformed, file.name,
                       std::string("expected the model ") + burnish::name(model()) + " as in " + of + ", got " +
                           burnish::name(other));
    reader.require_size(width(), height(), of);
    MaterialTexture head = read_head(reader, model(), which);
    if (reader.levels() != levels)
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected " + counted(std::size_t(levels), "level") + " as in " + of + ", got " +
                           std::to_string(reader.levels()));
    return head;
  };
  like_.b = open(b, 'b');
  like_.n = open(n, 'n');
}

MaterialTextures MaterialTexturesReader::rows(int first, int count) {
  MaterialTextures rows = like_;
  rows.first_row = first;
  for (std::size_t i = 0; i < 3; i++) {
    Image& to = rows.all()[i]->levels.emplace_back(width(), count, readers_[i].channels());
    readers_[i].read_rows(first, count, to.data.data());
    require_finite(readers_[i], to, first);
  }
  return rows;
}

MaterialTextures MaterialTexturesReader::read_all() {
  MaterialTextures textures = like_;
  for (std::size_t i = 0; i < 3; i++) {
    textures.all()[i]->levels = read_image_chain(readers_[i]);
    for (const Image& level : textures.all()[i]->levels) require_finite(readers_[i], level, 0);
  }
  return textures;
}

MaterialTextures read_material_textures(const FileRef& t, const FileRef& b, const FileRef& n) {
  return MaterialTexturesReader(t, b, n).read_all();
}

}  // namespace burnish
