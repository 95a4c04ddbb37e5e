// Words and numbers of things in messages.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace burnish {

// "1 texel", "2 texels"; nouns whose plural takes an s.
inline std::string counted(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

// "R, G, B"; joined(words, ", ", " or ") is "R, G or B".
inline std::string joined(const std::vector<std::string>& words, const std::string& between, const std::string& last) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); i++)
    all += (i == 0 ? "" : i + 1 == words.size() ? last : between) + words[i];
  return all;
}
inline std::string joined(const std::vector<std::string>& words, const std::string& between = ", ") {
  return joined(words, between, between);
}

}  // namespace burnish
