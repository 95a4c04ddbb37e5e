#include "burnish/render/ptm/ptm_assets.h"

#include <nlohmann/json.hpp>

#include "burnish/brdf/limited_brdf.h"
#include "burnish/brdf/measured/measured_brdf.h"
#include "burnish/brdf/model_brdf.h"
#include "burnish/core/error.h"
#include "burnish/core/whole_image.h"
#include "burnish/ptm/files/open_ptm.h"
#include "burnish/ptm/files/ptm_textures.h"

namespace burnish {
namespace {

constexpr double kWhite = 255;

PtmTextures open_textures(const std::string& prefix) {
  PtmTextureFiles files;
  const auto names = ptm_texture_names();
  for (std::size_t i = 0; i < files.images.size(); i++) files.images[i] = prefix + names[i];
  files.json = prefix + names.back();
  return read_ptm_textures(files);
}

PtmTexture texture_of(const PtmRows& rows) {
  const PtmShape& shape = rows.shape();
  const int of_texel = shape.polynomials() * kPtmTerms;
  PtmTexture out{shape.type, Image(shape.width, shape.height, of_texel + shape.colours()), {}, {}};
  const PtmBytes* bytes = rows.bytes();
  std::vector<float> coefficients(std::size_t(shape.width) * of_texel),
      colour(std::size_t(shape.width) * shape.colours());
  for (int y = 0; y < shape.height; y++) {
    if (!bytes) rows.read(y, 1, coefficients.data(), colour.data());
    for (int x = 0; x < shape.width; x++) {
      const std::size_t texel = std::size_t(y) * shape.width + x;
      float* to = out.stored.at(x, y);
      for (int k = 0; k < of_texel; k++)
        *to++ = float(
            (bytes ? float(bytes->coefficients[texel * of_texel + k]) : coefficients[std::size_t(x) * of_texel + k]) /
            kWhite);
      for (int c = 0; c < shape.colours(); c++)
        *to++ = float((bytes ? float(bytes->colour[texel * 3 + c]) : colour[std::size_t(x) * 3 + c]) / kWhite);
    }
  }
  out.scale.fill(1);
  if (bytes)
    for (int k = 0; k < kPtmTerms; k++) out.scale[k] = bytes->scale[k], out.bias[k] = bytes->bias[k] / kWhite;
  return out;
}

PtmTexture read_texture(const std::string& map) {
  return texture_of(map.ends_with('/') ? *open_textures(map).rows : *open_ptm(map).rows);
}

void read_description(const std::string& prefix, const std::string& text, PtmAssets& out) {
  const auto json = nlohmann::json::parse(text);
  const auto fail = [&](const std::string& message) {
    return file_error(ErrorKind::kMalformed, prefix + ptm_texture_names().back(), message);
  };
  const std::string parameters = json.value("parameters", nlohmann::json()).is_string() ? json["parameters"] : "";
  if (parameters == name(BrdfCoordinates::kLightView)) out.coordinates = BrdfCoordinates::kLightView;
  else if (parameters != name(BrdfCoordinates::kHalfDifference))
    throw fail("expected parameters half-difference or light-view, as burnish-ptm brdf writes them");
  const auto factor = json.value("noise_factor", nlohmann::json());
  if (!factor.is_number() || !(factor > 0 && factor <= 1)) throw fail("expected noise_factor above 0 and up to 1");
  out.noise_factor = factor;
}

}  // namespace

PtmAssets load_ptm(const PtmSource& source) {
  PtmAssets out;
  if (!source.is_brdf()) {
    out.map = read_texture(source.map);
    out.reference = source.reference.empty() ? out.map : read_texture(source.reference);
    return out;
  }
  const PtmTextures textures = open_textures(source.map);
  out.map = texture_of(*textures.rows);
  read_description(source.map, textures.description.text, out);
  out.brdf = is_model_source(source.brdf) ? model_brdf(source.brdf) : read_measured_brdf(source.brdf);
  if (source.ceiling) out.brdf = std::make_shared<const LimitedBrdf>(std::move(out.brdf), *source.ceiling);
  return out;
}

}  // namespace burnish
