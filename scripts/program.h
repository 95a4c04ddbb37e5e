// The main() of a program that makes samples or measures them.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace burnish {

using Arguments = std::vector<std::string>;

struct WrongUse {};

// An argument in a range; the fallback where it is not given.
inline int integer_argument(const Arguments& arguments, std::size_t at, int fallback, int least, int most) {
  if (at >= arguments.size()) return fallback;
  const std::string& text = arguments[at];
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) throw WrongUse();
  return value;
}

// body(arguments), as many as in "name FIRST [SECOND]". Exit code 0; 1 with that line for WrongUse; 2 for an error.
template <typename Body>
int run_program(const std::string& usage, int argc, char** argv, const Body& body) {
  const auto most = std::ranges::count(usage, ' '), least = most - std::ranges::count(usage, '[');
  try {
    if (argc - 1 < least || argc - 1 > most) throw WrongUse();
    body(Arguments(argv + 1, argv + argc));
    return 0;
  } catch (const WrongUse&) {
    std::fprintf(stderr, "usage: %s\n", usage.c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: error: %s\n", usage.substr(0, usage.find(' ')).c_str(), error.what());
    return 2;
  }
}

}  // namespace burnish
