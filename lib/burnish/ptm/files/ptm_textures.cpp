#include "burnish/ptm/files/ptm_textures.h"

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <variant>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/ptm/multiplied_out.h"
#include "burnish/ptm/round_ptm.h"

namespace burnish {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kColours = 3, kTermsOfImage = 3;

Json as_json(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* json = std::get_if<JsonText>(&value)) return Json::parse(json->text);
  const auto& numbers = std::get<std::vector<double>>(value);
  return numbers.size() == 1 ? Json(numbers[0]) : Json(numbers);
}

Json description(const PtmBytes& map, PtmType made_of, const Attributes& also) {
  Json json{{"width", map.width}, {"height", map.height}, {"type", name(made_of)}};
  for (const auto& [which, first] : {std::pair{"abc", 0}, {"def", kTermsOfImage}}) {
    // Light of 255 is 1 here, and so is a texel of 255: the scale stays.
    Json scale = Json::array(), bias = Json::array();
    for (int k = first; k < first + kTermsOfImage; k++) {
      scale.push_back(map.scale[k]);
      bias.push_back(map.bias[k] / 255.0);
    }
    json[which + std::string("_scale")] = scale;
    json[which + std::string("_bias")] = bias;
  }
  for (const auto& [key, value] : also) json[key] = as_json(value);
  return json;
}

void write_text(const FileRef& file, const std::string& text) {
  std::ofstream out(file.path, std::ios::binary);
  if (!out.write(text.data(), std::streamsize(text.size())) || !out.flush())
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

std::array<std::string, 7> ptm_texture_names() {
  return {"abc_red.png", "def_red.png", "abc_green.png", "def_green.png", "abc_blue.png", "def_blue.png", "ptm.json"};
}

void write_ptm_textures(const PtmTextureFiles& files, const PtmRows& rows,
                        const std::array<PtmCoefficients<double>, kPtmTerms>& normal, const Attributes& also) {
  const bool are_bytes = rows.shape().type == PtmType::kRgb && rows.bytes();
  const PtmBytes map = are_bytes ? *rows.bytes() : rounded(MultipliedOut(rows), normal);
  std::vector<std::uint8_t> row(std::size_t(map.width) * kTermsOfImage);
  for (int i = 0; i < 2 * kColours; i++) {
    ImageWriter image(files.images[i], FileType::kPng, SampleType::kUint8, map.width, map.height, kTermsOfImage);
    for (int y = 0; y < map.height; y++) {
      const std::uint8_t* from = map.coefficients.data() + std::size_t(y) * map.width * kColours * kPtmTerms;
      for (int x = 0; x < map.width; x++)
        std::copy_n(from + (std::size_t(x) * 2 * kColours + i) * kTermsOfImage, kTermsOfImage,
                    row.begin() + std::size_t(x) * kTermsOfImage);
      image.write_rows_stored(1, row.data());
    }
    image.close();
  }
  write_text(files.json, description(map, rows.shape().type, also).dump(2) + "\n");
}

}  // namespace burnish
