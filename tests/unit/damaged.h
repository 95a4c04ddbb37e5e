// Bytes of a file with something wrong, for readers that must refuse it or read it soundly.
#pragma once

#include <cstddef>
#include <random>
#include <string>

namespace burnish::testing {

// The i-th of many: a byte changed, some taken out, or some put in, among the first `head` twice as often as anywhere.
// `likely`: what half of the new bytes are of, such as digits in a text.
inline std::string damaged(const std::string& bytes, std::size_t head, const std::string& likely, int i,
                           std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::size_t(random() % n); };
  std::string out = bytes;
  const std::size_t at = below(i % 3 ? head : bytes.size());
  const char byte = i % 2 ? char(below(256)) : likely[below(likely.size())];
  switch (i / 2 % 4) {
    case 0:
    case 1:
      out[at] = byte;
      break;
    case 2:
      out.erase(at, 1 + below(3));
      break;
    default:
      out.insert(at, i % 4 ? std::string(1, byte) : bytes.substr(below(bytes.size()), 1 + below(12)));
  }
  return out;
}

}  // namespace burnish::testing
