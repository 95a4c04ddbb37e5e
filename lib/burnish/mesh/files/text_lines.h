// A text file, statement by statement and word by word, for readers that say which line is wrong.
//
// Lines end in \n, \r\n or \r, words are parted by blanks. Errors: kMalformed, "line 4: expected …, got …".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "burnish/core/number_text.h"

namespace burnish {

// For messages: in quotes, without bytes that are not printable, and not too long.
std::string quoted(std::string_view word);
// Whether the whole word is a number. Too large ones become infinity, too small ones 0.
bool parse_number(std::string_view word, double& value);
// Whether it is finite and single precision reaches as far, so that no area overflows a double.
bool in_range(double value);
inline constexpr const char* kInRange = "a finite number within single precision";  // for messages

class TextLines {
 public:
  struct Syntax {
    char comment = '\n';     // begins one that goes to the line's end; '\n': there are none
    bool continued = false;  // a \ before the line's end takes the next line in
  };
  // The text and the name must live longer.
  TextLines(std::string_view text, const std::string& name, Syntax syntax);

  // To the next line that has words; false at the file's end.
  bool next_line();
  // The same, where there has to be one.
  void require_line(const std::string& expected);
  // The next word; empty at the line's end.
  std::string_view word();
  // The next number, in range.
  double number();
  // The next integer.
  template <typename T>
  T integer(const char* expected) {
    const std::string_view w = word();
    const std::optional<T> value = number_in<T>(w);
    if (!value) refuse_word(expected, w);
    return *value;
  }
  bool has_word() const;
  std::size_t words_left() const;
  void require_line_end();
  // What follows this line.
  std::string_view rest_of_file() const { return text_.substr(next_); }

  std::size_t line() const { return line_number_; }
  [[noreturn]] void refuse(const std::string& expected, const std::string& got) const;
  [[noreturn]] void refuse_word(const std::string& expected, std::string_view word) const;

 private:
  std::size_t behind_newline(std::size_t i) const;

  std::string_view text_, line_;
  const std::string& name_;
  Syntax syntax_;
  std::size_t next_ = 0, line_number_ = 1, next_number_ = 1;
};

}  // namespace burnish
