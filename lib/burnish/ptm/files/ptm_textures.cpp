#include "burnish/ptm/files/ptm_textures.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <variant>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/whole_file.h"
#include "burnish/core/whole_image.h"
#include "burnish/ptm/multiplied_out.h"
#include "burnish/ptm/round_ptm.h"

namespace burnish {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kColours = 3, kTermsOfImage = 3, kLargestSide = 1 << 20;

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

// What ptm.json says of the bytes.
struct Description {
  PtmShape shape;
  PtmType made_of = PtmType::kRgb;
  PtmCoefficients<double> scale{}, bias{};  // light and texels of 255
  std::string text;
};

class DescriptionReader {
 public:
  explicit DescriptionReader(const FileRef& file) : name_(file.name), text_(read_file(file)) {
    json_ = Json::parse(text_, nullptr, false);
    if (!json_.is_object()) fail("expected a JSON object");
  }

  Description read() const {
    Description d;
    d.text = text_;
    d.shape = {PtmType::kRgb, side("width"), side("height")};
    const std::string type = member("type").is_string() ? member("type").get<std::string>() : "";
    if (type != name(PtmType::kLrgb) && type != name(PtmType::kRgb)) fail("expected type lrgb or rgb");
    d.made_of = type == name(PtmType::kRgb) ? PtmType::kRgb : PtmType::kLrgb;
    for (int k = 0; k < kPtmTerms; k++) {
      const std::string which = k < kTermsOfImage ? "abc" : "def";
      d.scale[k] = number(which + "_scale", k % kTermsOfImage);
      d.bias[k] = number(which + "_bias", k % kTermsOfImage) * 255;
    }
    if (!floats_hold(d.scale, d.bias)) fail("expected coefficients that floats hold, got a scale or bias beyond them");
    return d;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw file_error(ErrorKind::kMalformed, name_, message); }

  const Json& member(const std::string& key) const {
    if (!json_.contains(key)) fail("expected a member " + key + ", got none");
    return json_[key];
  }
  int side(const std::string& key) const {
    const Json& value = member(key);
    if (!value.is_number_integer() || value.get<double>() < 1 || value.get<double>() > kLargestSide)
      fail("expected " + key + " from 1 to " + std::to_string(kLargestSide) + ", got " + excerpt(value.dump()));
    return value.get<int>();
  }
  double number(const std::string& key, int k) const {
    const Json& values = member(key);
    const bool are_three = values.is_array() && values.size() == kTermsOfImage && values[k].is_number();
    if (!are_three || !std::isfinite(values[k].get<double>()))
      fail("expected " + key + " of three numbers, got " + excerpt(values.dump()));
    return values[k].get<double>();
  }

  std::string name_, text_;
  Json json_;
};

// The six images, in the order of a PtmBytes.
std::vector<std::uint8_t> read_images(const PtmTextureFiles& files, const PtmShape& shape) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 2 * kColours; i++) {
    ImageReader image(files.images[i]);
    image.require_size(shape.width, shape.height, "'" + files.json.name + "'");
    if (image.channels() != kTermsOfImage || !image.has_exact_samples() || image.sample_type() != SampleType::kUint8)
      throw file_error(
          ErrorKind::kMalformed, image.name(),
          "expected 3 channels of uint8, got " + std::to_string(image.channels()) + " of " + name(image.sample_type()));
    const auto texture = read_whole<std::uint8_t>(
        image.name(), shape.height, std::size_t(shape.width) * kTermsOfImage,
        [&](int first, int count, std::uint8_t* out) { image.read_rows_stored(first, count, out); });
    bytes.resize(shape.texels() * kColours * kPtmTerms);
    for (std::size_t t = 0; t < shape.texels(); t++)
      std::copy_n(texture.begin() + t * kTermsOfImage, kTermsOfImage,
                  bytes.begin() + (t * 2 * kColours + i) * kTermsOfImage);
  }
  return bytes;
}

bool are_whole(const PtmCoefficients<double>& bias) {
  return std::ranges::all_of(bias,
                             [](double b) { return std::abs(b) < 1 << 30 && std::abs(b - std::round(b)) < 1e-6; });
}

}  // namespace

PtmTextures read_ptm_textures(const PtmTextureFiles& files) {
  Description d = DescriptionReader(files.json).read();
  std::vector<std::uint8_t> bytes = read_images(files, d.shape);
  PtmTextures out{nullptr, d.made_of, {std::move(d.text)}};
  if (are_whole(d.bias)) {
    PtmBytes map{d.shape, d.scale, {}, std::move(bytes), {}};
    std::ranges::transform(d.bias, map.bias.begin(), [](double b) { return int(std::lround(b)); });
    out.rows = std::make_unique<PtmInBytes>(std::move(map));
  } else {
    Ptm map{d.shape, std::vector<float>(bytes.size()), {}};
    for (std::size_t i = 0; i < bytes.size(); i++)
      map.coefficients[i] = float((bytes[i] - d.bias[i % kPtmTerms]) * d.scale[i % kPtmTerms]);
    out.rows = std::make_unique<PtmInMemory>(std::move(map));
  }
  return out;
}

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
  write_file(files.json, description(map, rows.shape().type, also).dump(2) + "\n");
}

}  // namespace burnish
