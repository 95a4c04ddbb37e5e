#include "burnish/ptm/files/header_text.h"

#include <cmath>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {
namespace {

constexpr std::size_t kLongestWord = 64;

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

void HeaderText::fail(const std::string& message) const { throw file_error(ErrorKind::kMalformed, name_, message); }

std::string HeaderText::word(const char* what) {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) at_++;
  const std::size_t first = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && at_ - first < kLongestWord) at_++;
  if (at_ == first) fail(std::string("expected ") + what + ", got the end of the file");
  return std::string(bytes_.substr(first, at_ - first));
}

double HeaderText::number(const char* what) {
  const std::string text = word(what);
  const std::optional<double> value = number_in<double>(std::string_view(text).substr(text[0] == '+'));
  if (!value || !std::isfinite(*value)) fail(std::string("expected ") + what + ", got '" + excerpt(text) + "'");
  return *value;
}

int HeaderText::integer(const char* what, int least, int most) {
  const double value = number(what);
  if (!(value >= least && value <= most && value == std::floor(value)))
    fail(std::string("expected ") + what + " from " + std::to_string(least) + " to " + std::to_string(most) + ", got " +
         number_text(value));
  return int(value);
}

std::vector<int> HeaderText::integers(const char* what, std::size_t count, int least, int most) {
  std::vector<int> values(count);
  for (int& value : values) value = integer(what, least, most);
  return values;
}

std::string_view HeaderText::body(const char* last) {
  while (at_ < bytes_.size() && is_blank(bytes_[at_]) && bytes_[at_] != '\n') at_++;
  if (at_ == bytes_.size() || bytes_[at_] != '\n')
    fail(std::string("expected the end of a line behind the ") + last + ", got " +
         (at_ == bytes_.size() ? "the end of the file" : "'" + excerpt(std::string(bytes_.substr(at_, 8))) + "'"));
  return bytes_.substr(at_ + 1);
}

}  // namespace burnish
