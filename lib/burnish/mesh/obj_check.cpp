#include "burnish/mesh/obj_check.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
#include <vector>

#include "burnish/core/error.h"

namespace burnish {
namespace {

std::vector<std::string_view> words(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> out;
  for (std::size_t begin = line.find_first_not_of(kBlank); begin != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlank, end);
  }
  return out;
}

template <typename T>
bool parse(std::string_view text, T& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

class ObjCheck {
 public:
  explicit ObjCheck(const FileRef& file) : name_(file.name) {}

  void line(std::string_view text) {
    number_++;
    const std::vector<std::string_view> w = words(text.substr(0, text.find('#')));
    if (w.empty()) return;
    if (w[0] == "v") element(w, kinds_[0], 3);
    else if (w[0] == "vt") element(w, kinds_[1], 2);
    else if (w[0] == "vn") element(w, kinds_[2], 3);
    else if (w[0] == "f") face(w);
  }

  ObjContents finish() const {
    for (const Kind& k : kinds_)
      if (k.largest > k.count)
        refuse(k.largest_line, "expected " + std::string(k.what) + " 1 to " + std::to_string(k.count) + ", got " +
                                   std::to_string(k.largest));
    return {faces_, kinds_[1].named, kinds_[2].named};
  }

 private:
  struct Kind {
    const char* what;
    long count = 0, largest = 0;
    std::size_t largest_line = 0;
    bool named = false;  // by the corners of the first face, so that all must
  };

  [[noreturn]] void refuse(std::size_t line, const std::string& message) const {
    throw file_error(ErrorKind::kMalformed, name_, "line " + std::to_string(line) + ": " + message);
  }

  void element(const std::vector<std::string_view>& w, Kind& kind, std::size_t numbers) {
    kind.count++;
    for (std::size_t i = 1; i <= numbers; i++) {
      double value;
      if (i >= w.size() || !parse(w[i], value) || !std::isfinite(value))
        refuse(number_, "expected " + std::to_string(numbers) + " finite numbers after '" + std::string(w[0]) +
                            "', got '" + (i < w.size() ? std::string(w[i]) : "") + "'");
    }
  }

  void face(const std::vector<std::string_view>& w) {
    if (w.size() < 4) refuse(number_, "expected at least 3 corners of a face, got " + std::to_string(w.size() - 1));
    for (std::size_t i = 1; i < w.size(); i++) corner(w[i], faces_ == 0 && i == 1);
    faces_++;
  }

  // v, v/vt, v//vn or v/vt/vn
  void corner(std::string_view text, bool first) {
    std::string_view rest = text;
    for (std::size_t k = 0; k < 3; k++) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      const std::string_view part = rest.substr(0, slash);
      rest.remove_prefix(std::min(slash + 1, rest.size()));
      Kind& kind = kinds_[k];
      const bool named = !part.empty();
      if (first) kind.named = named;
      if (named != kind.named || (k == 0 && !named))
        refuse(number_, std::string("expected every corner to name its ") + kind.what + " or none to, got '" +
                            std::string(text) + "'");
      if (!named) continue;
      long index;
      if (!parse(part, index) || index == 0 || index < -kind.count)
        refuse(number_, "expected a corner as v, v/vt, v//vn or v/vt/vn, got '" + std::string(text) + "'");
      if (index > kind.largest) kind.largest = index, kind.largest_line = number_;
    }
  }

  std::string name_;
  std::size_t number_ = 0, faces_ = 0;
  Kind kinds_[3]{{"vertex"}, {"texture coordinate"}, {"normal"}};
};

}  // namespace

ObjContents check_obj(const FileRef& file) {
  std::ifstream in(file.path, std::ios::binary);
  ObjCheck check(file);
  for (std::string line; std::getline(in, line);) check.line(line);
  if (in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return check.finish();
}

}  // namespace burnish
