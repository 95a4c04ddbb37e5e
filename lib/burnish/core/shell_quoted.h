// Words as a shell takes them: as they stand where they can, otherwise in quotes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace burnish {

inline std::string shell_quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789-_=+./:,@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The words of a text, with quotes and backslashes as in a shell, and nothing else that a shell would expand. None
// where a quote is left open.
inline std::optional<std::vector<std::string>> shell_words(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); i++) {
    const char c = text[i];
    const bool blank = !quote && (c == ' ' || c == '\t' || c == '\n' || c == '\r');
    if (blank) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back(), inside = true;
    if (c == quote) quote = 0;
    else if (!quote && (c == '\'' || c == '"')) quote = c;
    else if (c == '\\' && quote != '\'' && i + 1 < text.size()) words.back() += text[++i];
    else words.back() += c;
  }
  if (quote) return std::nullopt;
  return words;
}

}  // namespace burnish
