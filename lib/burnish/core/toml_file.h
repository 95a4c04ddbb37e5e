// A TOML file as typed values that know their key and line, so that every refusal names both.
//
// Each accessor checks type and range, takes the fallback where the key is absent, and throws kMalformed
// where there is none:
//   'scene.toml': line 12: 'camera.fov_deg': expected an angle above 0 and below 180, got 200
// A key that no accessor asked for is unknown: refuse_unknown() names the first of them.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

// Which numbers a key takes, and the same in words for messages.
struct NumberRange {
  double least, most;
  const char* text;
};

inline constexpr double kAboveZero = std::numeric_limits<double>::min();
inline constexpr NumberRange kAnyNumber{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                                        "a finite number"};
inline constexpr NumberRange kPositive{kAboveZero, std::numeric_limits<double>::max(), "a number above 0"};
inline constexpr NumberRange kNotNegative{0, std::numeric_limits<double>::max(), "a number of at least 0"};

class TomlTable {
 public:
  // The root of a file's text; `name` is for messages. kMalformed where the text is no TOML.
  static TomlTable parse(std::string_view text, const std::string& name);

  bool has(const std::string& key) const;
  bool has_array(const std::string& key) const;
  bool is_text(const std::string& key) const;
  // Without a fallback the key is required.
  double number(const std::string& key, const NumberRange& range, std::optional<double> fallback = {}) const;
  int integer(const std::string& key, int least, int most, std::optional<int> fallback = {}) const;
  std::string text(const std::string& key, std::optional<std::string> fallback = {}) const;
  bool boolean(const std::string& key, bool fallback) const;
  // A string, or an array of strings; none where the key is absent.
  std::vector<std::string> texts(const std::string& key) const;
  // The name of a file, relative to a directory; empty where the key is absent.
  std::string file(const std::string& key, const std::string& directory) const;
  // An array of exactly three, or of `count`, numbers.
  Vec3d vector(const std::string& key, const NumberRange& range, std::optional<Vec3d> fallback = {}) const;
  std::vector<double> numbers(const std::string& key, std::size_t count, const NumberRange& range) const;
  // One of several words.
  template <typename T>
  T choice(const std::string& key, const std::vector<std::pair<std::string, T>>& words,
           std::optional<T> fallback = {}) const;
  // [key]; an empty table where it is absent.
  TomlTable table(const std::string& key) const;
  // [[key]]; none where it is absent.
  std::vector<TomlTable> tables(const std::string& key) const;

  void refuse_unknown() const;
  // kMalformed: 'file': line n: 'key': message. The line is the key's, or the table's where the key is
  // absent.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  struct Impl;
  explicit TomlTable(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<Impl> impl_;
};

template <typename T>
T TomlTable::choice(const std::string& key, const std::vector<std::pair<std::string, T>>& words,
                    std::optional<T> fallback) const {
  if (fallback && !has(key)) return *fallback;
  const std::string given = text(key);
  std::string all;
  for (const auto& [word, value] : words) {
    if (word == given) return value;
    all += (all.empty() ? "" : "|") + word;
  }
  fail(key, "expected " + all + ", got '" + given + "'");
}

}  // namespace burnish
