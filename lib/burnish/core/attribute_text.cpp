#include "burnish/core/attribute_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>

namespace burnish::detail {
namespace {

using Json = nlohmann::ordered_json;

const std::string kDescription = "ImageDescription";

Json as_json(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* json = std::get_if<JsonText>(&value)) return Json::parse(json->text);
  const auto& numbers = std::get<std::vector<double>>(value);
  return numbers.size() == 1 ? Json(numbers[0]) : Json(numbers);
}

// The last of that name; null where there is none, or none of that type.
template <typename T>
const T* find(const Attributes& stored, const std::string& name) {
  for (const auto& [its_name, value] : stored | std::views::reverse)
    if (its_name == name) return std::get_if<T>(&value);
  return nullptr;
}

// A member of the description; null where there is none. Descriptions of other programs may be anything.
Json described(const Attributes& stored, const std::string& name) {
  const auto* description = find<std::string>(stored, kDescription);
  const Json all = Json::parse(description ? *description : "", nullptr, false);
  return all.is_object() && all.contains(name) ? all[name] : Json();
}

}  // namespace

Attributes stored_attributes(FileType type, const Attributes& attributes) {
  Attributes stored;
  if (type == FileType::kExr) {
    for (const auto& [name, value] : attributes) {
      const auto* json = std::get_if<JsonText>(&value);
      stored.emplace_back(name, json ? AttributeValue(json->text) : value);
    }
    return stored;
  }
  if (type != FileType::kPng && type != FileType::kTiff) return {};
  Json members = Json::object();
  for (const auto& [name, value] : attributes) {
    if (name == kDescription) stored.emplace_back(name, value);
    else members[name] = as_json(value);
  }
  if (!members.empty()) stored = {{kDescription, members.dump()}};
  return stored;
}

std::optional<std::string> text_attribute(const Attributes& stored, const std::string& name) {
  if (const auto* text = find<std::string>(stored, name)) return *text;
  const Json member = described(stored, name);
  if (member.is_null()) return std::nullopt;
  return member.is_string() ? member.get<std::string>() : member.dump();
}

std::optional<std::vector<double>> number_attribute(const Attributes& stored, const std::string& name) {
  if (const auto* numbers = find<std::vector<double>>(stored, name)) return *numbers;
  const Json member = described(stored, name);
  if (member.is_number()) return std::vector<double>{member.get<double>()};
  if (!member.is_array() || !std::ranges::all_of(member, [](const Json& v) { return v.is_number(); }))
    return std::nullopt;
  return member.get<std::vector<double>>();
}

}  // namespace burnish::detail
