// The text at the beginning of a .ptm file, word by word.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace burnish {

class HeaderText {
 public:
  // `bytes` of the whole file; `name` for messages. Both must outlive it.
  HeaderText(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  // Each throws kMalformed, naming `what` was expected, where it is not there.
  std::string word(const char* what);
  double number(const char* what);
  int integer(const char* what, int least, int most);
  std::vector<int> integers(const char* what, std::size_t count, int least, int most);
  // What stands behind the line that ends with `last`.
  std::string_view body(const char* last);

  const std::string& name() const { return name_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace burnish
