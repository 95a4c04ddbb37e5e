#include "cli/depfile.h"

namespace burnish::cli {
namespace {

// GNU make: backslashes are literal, save those before a space, tab or '#', which are halved; '$' is doubled.
std::string escaped(const std::string& path) {
  std::string out;
  std::size_t backslashes = 0;
  for (char c : path) {
    if (c == ' ' || c == '\t' || c == '#') out += std::string(backslashes, '\\') + '\\' + c;
    else if (c == '$') out += "$$";
    else out += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return out;
}

}  // namespace

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
  std::string text = escaped(target) + ":";
  for (const std::string& input : inputs) text += " " + escaped(input);
  return text + "\n";
}

}  // namespace burnish::cli
