#include "cli/argument_files.h"

#include <optional>

#include "burnish/core/error.h"
#include "burnish/core/shell_quoted.h"
#include "burnish/core/whole_file.h"

namespace burnish::cli {

std::vector<std::string> with_arguments_of_files(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  const std::string option = kArgumentsFrom;
  for (std::size_t i = 0; i < words.size(); i++) {
    std::string file;
    if (words[i].starts_with(option + "=")) file = words[i].substr(option.size() + 1);
    else if (words[i] == option && i + 1 < words.size()) file = words[++i];
    else {
      all.push_back(words[i]);
      continue;
    }
    const std::string text = read_file(file);
    if (text.find('\0') != text.npos) throw file_error(ErrorKind::kMalformed, file, "expected text, got other bytes");
    const std::optional<std::vector<std::string>> more = shell_words(text);
    if (!more) throw file_error(ErrorKind::kMalformed, file, "expected quotes in pairs, got one that stays open");
    all.insert(all.end(), more->begin(), more->end());
  }
  return all;
}

}  // namespace burnish::cli
