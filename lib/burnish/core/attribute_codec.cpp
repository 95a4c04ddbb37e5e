#include "burnish/core/attribute_codec.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace burnish::detail {
namespace {

using Json = nlohmann::ordered_json;

const std::string kDescription = "ImageDescription";

void put_each(OIIO::ImageSpec& spec, const Attributes& attributes) {
  for (const auto& [name, value] : attributes) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      spec.attribute(name, *text);
    } else if (const auto* json = std::get_if<JsonText>(&value)) {
      spec.attribute(name, json->text);
    } else {
      const auto& numbers = std::get<std::vector<double>>(value);
      const std::vector<float> floats(numbers.begin(), numbers.end());
      const OIIO::TypeDesc one = OIIO::TypeDesc::FLOAT;
      spec.attribute(name, floats.size() == 1 ? one : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, int(floats.size())),
                     floats.data());
    }
  }
}

Json as_json(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* json = std::get_if<JsonText>(&value)) return Json::parse(json->text);
  const auto& numbers = std::get<std::vector<double>>(value);
  return numbers.size() == 1 ? Json(numbers[0]) : Json(numbers);
}

// A member of the description; null where there is none. Descriptions of other programs may be anything.
Json described(const OIIO::ImageSpec& spec, const std::string& name) {
  const Json all = Json::parse(std::string(spec.get_string_attribute(kDescription)), nullptr, false);
  return all.is_object() && all.contains(name) ? all[name] : Json();
}

}  // namespace

void put_attributes(OIIO::ImageSpec& spec, FileType type, const Attributes& attributes) {
  if (type == FileType::kExr) return put_each(spec, attributes);
  if (type != FileType::kPng && type != FileType::kTiff) return;
  Json members = Json::object();
  for (const auto& [name, value] : attributes) {
    if (name == kDescription) spec.attribute(name, std::get<std::string>(value));
    else members[name] = as_json(value);
  }
  if (!members.empty()) spec.attribute(kDescription, members.dump());
}

std::optional<std::string> text_attribute(const OIIO::ImageSpec& spec, const std::string& name) {
  if (spec.find_attribute(name, OIIO::TypeDesc::STRING)) return std::string(spec.get_string_attribute(name));
  const Json member = described(spec, name);
  if (member.is_null()) return std::nullopt;
  return member.is_string() ? member.get<std::string>() : member.dump();
}

std::optional<std::vector<double>> number_attribute(const OIIO::ImageSpec& spec, const std::string& name) {
  if (const auto* found = spec.find_attribute(name); found && found->type().basetype == OIIO::TypeDesc::FLOAT) {
    const auto* floats = static_cast<const float*>(found->data());
    return std::vector<double>(floats, floats + found->type().numelements() * found->type().aggregate);
  }
  const Json member = described(spec, name);
  if (member.is_number()) return std::vector<double>{member.get<double>()};
  if (!member.is_array() || !std::ranges::all_of(member, [](const Json& v) { return v.is_number(); }))
    return std::nullopt;
  return member.get<std::vector<double>>();
}

}  // namespace burnish::detail
