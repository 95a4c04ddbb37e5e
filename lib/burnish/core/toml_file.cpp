#include "burnish/core/toml_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/wording.h"

namespace burnish {

struct TomlTable::Impl {
  std::shared_ptr<const toml::table> root;  // keeps `table` alive
  const toml::table* table;
  std::string file, prefix;  // prefix: "camera." or "light[1]."
  int line;
  std::set<std::string, std::less<>> asked;

  const toml::node* find(const std::string& key) {
    asked.insert(key);
    return table->get(key);
  }
};

namespace {

int line_of(const toml::node& node) { return int(node.source().begin.line); }

// 2.0, which is no integer
std::string float_text(double value) {
  const std::string text = number_text(value);
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

std::string shown(const toml::node& node) {
  if (node.is_table()) return "a table";
  std::ostringstream out;
  if (node.is_array()) out << "an array of " << node.as_array()->size();
  else
    node.visit([&](const auto& value) {
      if constexpr (toml::is_floating_point<decltype(value)>) out << float_text(*value);
      else if constexpr (toml::is_value<decltype(value)>) out << value;
    });
  return out.str();
}

std::optional<double> number_in(const toml::node& node, const NumberRange& range) {
  if (!node.is_number()) return {};
  const double value = *node.value<double>();
  if (!(value >= range.least && value <= range.most)) return {};
  return value;
}

// In one line, though keys and texts may hold the end of one.
[[noreturn]] void fail_at(const std::string& file, int line, std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char c) { return std::iscntrl(c); }, '?');
  throw file_error(ErrorKind::kMalformed, file, "line " + std::to_string(line) + ": " + message);
}

}  // namespace

TomlTable TomlTable::parse(std::string_view text, const std::string& name) {
  // A key of very many parts makes tables so deep that taking them down again overflows the stack; it fills one line.
  constexpr std::size_t kLongestLine = 10000;
  for (std::size_t begin = 0, line = 1; begin < text.size(); line++) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kLongestLine)
      throw file_error(
          ErrorKind::kMalformed, name,
          "line " + std::to_string(line) + ": expected at most " + std::to_string(kLongestLine) + " characters");
    begin = end + 1;
  }
  try {
    auto root = std::make_shared<const toml::table>(toml::parse(text));
    const toml::table* table = root.get();
    return TomlTable(std::make_shared<Impl>(Impl{std::move(root), table, name, "", 1, {}}));
  } catch (const toml::parse_error& error) {
    fail_at(name, int(error.source().begin.line), std::string(error.description()));
  }
}

bool TomlTable::has(const std::string& key) const { return impl_->find(key) != nullptr; }

bool TomlTable::has_array(const std::string& key) const {
  const toml::node* node = impl_->find(key);
  return node && node->is_array();
}

bool TomlTable::is_text(const std::string& key) const {
  const toml::node* node = impl_->find(key);
  return node && node->is_string();
}

void TomlTable::fail(const std::string& key, const std::string& message) const {
  const toml::node* node = impl_->table->get(key);
  fail_at(impl_->file, node ? line_of(*node) : impl_->line, "'" + impl_->prefix + key + "': " + message);
}

double TomlTable::number(const std::string& key, const NumberRange& range, std::optional<double> fallback) const {
  const toml::node* node = impl_->find(key);
  if (!node && fallback) return *fallback;
  if (!node) fail(key, std::string("expected ") + range.text + ", got nothing");
  const std::optional<double> value = number_in(*node, range);
  if (!value) fail(key, std::string("expected ") + range.text + ", got " + shown(*node));
  return *value;
}

int TomlTable::integer(const std::string& key, int least, int most, std::optional<int> fallback) const {
  const std::string what = "an integer from " + std::to_string(least) + " to " + std::to_string(most);
  const toml::node* node = impl_->find(key);
  if (!node && fallback) return *fallback;
  if (!node) fail(key, "expected " + what + ", got nothing");
  const std::optional<std::int64_t> value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most) fail(key, "expected " + what + ", got " + shown(*node));
  return int(*value);
}

std::string TomlTable::text(const std::string& key, std::optional<std::string> fallback) const {
  const toml::node* node = impl_->find(key);
  if (!node && fallback) return *fallback;
  if (!node) fail(key, "expected a string, got nothing");
  if (!node->is_string()) fail(key, "expected a string, got " + shown(*node));
  return node->as_string()->get();
}

bool TomlTable::boolean(const std::string& key, bool fallback) const {
  const toml::node* node = impl_->find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, "expected true or false, got " + shown(*node));
  return node->as_boolean()->get();
}

std::vector<std::string> TomlTable::texts(const std::string& key) const {
  const toml::node* node = impl_->find(key);
  if (!node) return {};
  if (node->is_string()) return {text(key)};
  const toml::array* array = node->as_array();
  if (!array) fail(key, "expected a string or an array of strings, got " + shown(*node));
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    if (!element.is_string()) fail(key, "expected strings, got " + shown(element));
    texts.push_back(element.as_string()->get());
  }
  return texts;
}

std::string TomlTable::file(const std::string& key, const std::string& directory) const {
  if (!has(key)) return {};
  const std::string path = text(key);
  if (path.empty()) fail(key, "expected a file name, got ''");
  return (std::filesystem::path(directory) / path).string();
}

std::vector<double> TomlTable::numbers(const std::string& key, std::size_t count, const NumberRange& range) const {
  const std::string what = "an array of " + std::to_string(count) + ", each " + range.text;
  const toml::node* node = impl_->find(key);
  if (!node) fail(key, "expected " + what + ", got nothing");
  const toml::array* array = node->as_array();
  if (!array || array->size() != count) fail(key, "expected " + what + ", got " + shown(*node));
  std::vector<double> values;
  for (const toml::node& element : *array) {
    const std::optional<double> value = number_in(element, range);
    if (!value) fail(key, "expected " + what + ", got " + shown(element));
    values.push_back(*value);
  }
  return values;
}

Vec3d TomlTable::vector(const std::string& key, const NumberRange& range, std::optional<Vec3d> fallback) const {
  if (fallback && !has(key)) return *fallback;
  const std::vector<double> v = numbers(key, 3, range);
  return {v[0], v[1], v[2]};
}

TomlTable TomlTable::table(const std::string& key) const {
  static const auto kEmpty = std::make_shared<const toml::table>();
  const toml::node* node = impl_->find(key);
  if (!node)
    return TomlTable(std::make_shared<Impl>(Impl{kEmpty, kEmpty.get(), impl_->file, key + ".", impl_->line, {}}));
  if (!node->is_table()) fail(key, "expected a table [" + key + "], got " + shown(*node));
  return TomlTable(std::make_shared<Impl>(
      Impl{impl_->root, node->as_table(), impl_->file, impl_->prefix + key + ".", line_of(*node), {}}));
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  std::vector<TomlTable> out;
  const toml::node* node = impl_->find(key);
  if (!node) return out;
  if (!node->is_array_of_tables() && !(node->is_array() && node->as_array()->empty()))
    fail(key, "expected tables [[" + key + "]], got " + shown(*node));
  for (const toml::node& element : *node->as_array())
    out.push_back(TomlTable(std::make_shared<Impl>(Impl{impl_->root,
                                                        element.as_table(),
                                                        impl_->file,
                                                        impl_->prefix + key + "[" + std::to_string(out.size()) + "].",
                                                        line_of(element),
                                                        {}})));
  return out;
}

void TomlTable::refuse_unknown() const {
  // Keys are stored by name; the first in the file is the one to name.
  const std::string* unknown = nullptr;
  int line = 0;
  std::vector<std::string> names;
  for (auto&& [key, node] : *impl_->table) names.emplace_back(key.str());
  for (const std::string& key : names) {
    if (impl_->asked.contains(key)) continue;
    const int at = line_of(*impl_->table->get(key));
    if (!unknown || at < line) unknown = &key, line = at;
  }
  if (!unknown) return;
  fail(*unknown, "unknown key; expected one of " + joined({impl_->asked.begin(), impl_->asked.end()}));
}

}  // namespace burnish
