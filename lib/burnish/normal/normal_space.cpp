#include "burnish/normal/normal_space.h"

#include <nlohmann/json.hpp>

#include "burnish/core/error.h"

namespace burnish {
namespace {

const std::string kAttribute = "burnish:space", kDescription = "ImageDescription";

}  // namespace

const char* name(NormalSpace space) { return space == NormalSpace::kTangent ? "tangent" : "object"; }

NormalSpace space_from_name(const std::string& text, const std::string& file_name) {
  if (text == "tangent") return NormalSpace::kTangent;
  if (text == "object") return NormalSpace::kObject;
  throw file_error(ErrorKind::kMalformed, file_name,
                   "expected burnish:space tangent or object, got '" + excerpt(text) + "'");
}

ImageWriter::Attributes space_attributes(FileType type, NormalSpace space) {
  if (type == FileType::kExr) return {{kAttribute, name(space)}};
  if (type != FileType::kPng && type != FileType::kTiff) return {};
  return {{kDescription, nlohmann::json{{kAttribute, name(space)}}.dump()}};
}

std::optional<NormalSpace> recorded_space(const ImageReader& reader) {
  std::string text = reader.text(kAttribute);
  if (text.empty()) {
    // Descriptions of other programs may be anything.
    const auto json = nlohmann::json::parse(reader.text(kDescription), nullptr, false);
    if (!json.is_object() || !json.contains(kAttribute)) return std::nullopt;
    text = json[kAttribute].is_string() ? json[kAttribute].get<std::string>() : json[kAttribute].dump();
  }
  return space_from_name(text, reader.name());
}

}  // namespace burnish
