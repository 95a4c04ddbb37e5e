// Numbers in messages: the fewest digits that are read back as the same number.
#pragma once

#include <charconv>
#include <concepts>
#include <string>

namespace burnish {

// "0.1", "180", "1e+30", "nan"; a float has a float's digits.
template <std::floating_point T>
std::string number_text(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace burnish
