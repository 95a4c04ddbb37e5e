#include "burnish/normal/normal_space.h"

#include "burnish/core/error.h"

namespace burnish {
namespace {

const std::string kAttribute = "burnish:space";

}  // namespace

const char* name(NormalSpace space) { return space == NormalSpace::kTangent ? "tangent" : "object"; }

NormalSpace space_from_name(const std::string& text, const std::string& file_name) {
  if (text == "tangent") return NormalSpace::kTangent;
  if (text == "object") return NormalSpace::kObject;
  throw file_error(ErrorKind::kMalformed, file_name,
                   "expected burnish:space tangent or object, got '" + excerpt(text) + "'");
}

Attributes space_attributes(NormalSpace space) { return {{kAttribute, name(space)}}; }

std::optional<NormalSpace> recorded_space(const ImageReader& reader) {
  const std::optional<std::string> text = reader.text(kAttribute);
  if (!text) return std::nullopt;
  return space_from_name(*text, reader.name());
}

std::optional<NormalSpace> agreed_space(const std::vector<SpaceOfFile>& files) {
  const SpaceOfFile* first = nullptr;
  for (const SpaceOfFile& f : files) {
    if (!f.space) continue;
    if (!first) first = &f;
    if (*f.space != *first->space)
      throw file_error(ErrorKind::kMalformed, f.name,
                       std::string("expected normals in ") + name(*first->space) + " space, as in '" + first->name +
                           "', got " + name(*f.space) + " space");
  }
  return first ? first->space : std::nullopt;
}

}  // namespace burnish
