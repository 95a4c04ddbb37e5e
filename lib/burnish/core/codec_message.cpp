#include "burnish/core/codec_message.h"

#include <algorithm>

namespace burnish {

std::string codec_message(const std::string& text, const FileRef& file) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  std::string line = text.substr(begin, text.find('\n', begin) - begin);
  line.erase(line.find_last_not_of(" \t\r") + 1);
  if (file.path == file.name || file.path.empty()) return line;
  for (std::size_t at = 0; (at = line.find(file.path, at)) != std::string::npos; at += file.name.size())
    line.replace(at, file.path.size(), file.name);
  return line;
}

}  // namespace burnish
