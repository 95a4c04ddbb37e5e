// Numbers as text.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace burnish {

// For messages, the fewest digits that are read back as the same number: "0.1", "180", "1e+30", "nan"; a float has a
// float's digits.
template <std::floating_point T>
std::string number_text(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// What a text says that is a number and nothing else, in range of T.
template <typename T>
std::optional<T> number_in(std::string_view text) {
  T value{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (text.empty() || error != std::errc() || end != last) return std::nullopt;
  return value;
}

}  // namespace burnish
