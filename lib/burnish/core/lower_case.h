// Names that mean the same in capitals.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace burnish {

// A to Z only, whatever the locale.
inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

// ".png" of "a/B.PNG"; empty where there is none.
inline std::string lower_case_extension(const std::string& file) {
  return lower_case(std::filesystem::path(file).extension().string());
}

}  // namespace burnish
