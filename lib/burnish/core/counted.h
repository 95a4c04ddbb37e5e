// Numbers of things in messages.
#pragma once

#include <cstddef>
#include <string>

namespace burnish {

// "1 texel", "2 texels"; nouns whose plural takes an s.
inline std::string counted(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace burnish
