#include "burnish/mesh/files/text_lines.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "burnish/core/error.h"

namespace burnish {
namespace {

bool is_newline(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }  // \t \n \v \f \r

// Empty where the line has no more. A newline inside of a line is a continued one.
std::string_view take_word(std::string_view& line) {
  for (;;) {
    std::size_t begin = 0;
    while (begin < line.size() && is_blank(line[begin])) begin++;
    std::size_t end = begin;
    while (end < line.size() && !is_blank(line[end])) end++;
    std::string_view word = line.substr(begin, end - begin);
    if (word.ends_with('\\') && end < line.size() && is_newline(line[end])) word.remove_suffix(1);
    line.remove_prefix(end);
    if (!word.empty() || line.empty()) return word;
  }
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t kMostShown = 40;
  std::string shown(word.substr(0, kMostShown));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return "'" + shown + (word.size() > kMostShown ? "…'" : "'");
}

bool parse_number(std::string_view word, double& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    const bool small = word.find("e-") != word.npos || word.find("E-") != word.npos;
    value = small ? 0 : std::numeric_limits<double>::infinity();
  } else if (error != std::errc()) {
    return false;
  }
  return end == word.data() + word.size();
}

bool in_range(double value) { return std::abs(value) <= FLT_MAX; }

TextLines::TextLines(std::string_view text, const std::string& name, Syntax syntax)
    : text_(text), name_(name), syntax_(syntax) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
}

bool TextLines::next_line() {
  while (next_ < text_.size()) {
    line_number_ = next_number_;
    const std::size_t begin = next_;
    const auto stops = [&](char c) { return is_newline(c) || c == syntax_.comment; };
    std::size_t end = begin;  // of the words
    for (;;) {
      while (end < text_.size() && !stops(text_[end])) end++;
      const bool goes_on =
          syntax_.continued && end > begin && end < text_.size() && is_newline(text_[end]) && text_[end - 1] == '\\';
      if (!goes_on) break;
      end = behind_newline(end);
      next_number_++;
    }
    std::size_t newline = end;
    while (newline < text_.size() && !is_newline(text_[newline])) newline++;
    next_ = behind_newline(newline);
    next_number_++;
    line_ = text_.substr(begin, end - begin);
    if (has_word()) return true;
  }
  line_ = {};
  return false;
}

void TextLines::require_line(const std::string& expected) {
  if (!next_line()) refuse(expected, "the end of the file");
}

std::string_view TextLines::word() { return take_word(line_); }

double TextLines::number() {
  const std::string_view w = word();
  double value = 0;
  if (w.empty() || !parse_number(w, value) || !in_range(value)) refuse_word(kInRange, w);
  return value;
}

bool TextLines::has_word() const {
  std::string_view left = line_;
  return !take_word(left).empty();
}

std::size_t TextLines::words_left() const {
  std::string_view left = line_;
  std::size_t count = 0;
  while (!take_word(left).empty()) count++;
  return count;
}

void TextLines::require_line_end() {
  if (const std::string_view w = word(); !w.empty()) refuse_word("the end of the line", w);
}

void TextLines::refuse(const std::string& expected, const std::string& got) const {
  throw file_error(ErrorKind::kMalformed, name_,
                   "line " + std::to_string(line_number_) + ": expected " + expected + ", got " + got);
}

void TextLines::refuse_word(const std::string& expected, std::string_view word) const {
  refuse(expected, word.empty() ? "the end of the line" : quoted(word));
}

std::size_t TextLines::behind_newline(std::size_t i) const {
  if (i >= text_.size()) return text_.size();
  return i + (text_.substr(i, 2) == "\r\n" ? 2 : 1);
}

}  // namespace burnish
