#include "burnish/ptm/light_list.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/whole_file.h"

namespace burnish {
namespace {

constexpr const char* kBlank = " \t\r";
constexpr std::size_t kMostPhotos = 1 << 16;
constexpr std::size_t kMostBytes = std::size_t(1) << 28;  // of a list with the longest names

class ListReader {
 public:
  explicit ListReader(const FileRef& file) : file_(file), in_(read_file(file, kMostBytes)) {}

  std::vector<LitPhoto> read() {
    const std::size_t count = read_count();
    std::vector<LitPhoto> photos;
    std::map<std::string, int> lines;
    while (next_line()) {
      if (photos.size() == count) fail("expected no more than the " + std::to_string(count) + " photos of line 1");
      photos.push_back(photo());
      if (const auto [at, is_new] = lines.emplace(photos.back().file, number_); !is_new)
        fail("'" + excerpt(photos.back().file) + "' is there already, in line " + std::to_string(at->second));
    }
    if (photos.size() < count)
      throw file_error(
          ErrorKind::kMalformed, file_.name,
          "expected " + std::to_string(count) + " photos, as line 1 says, got " + std::to_string(photos.size()));
    return photos;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw file_error(ErrorKind::kMalformed, file_.name, "line " + std::to_string(number_) + ": " + message);
  }

  // The next line that is not blank, without blanks at its ends.
  bool next_line() {
    while (std::getline(in_, line_)) {
      number_++;
      if (number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);
      line_.erase(0, line_.find_first_not_of(kBlank));
      line_.erase(line_.find_last_not_of(kBlank) + 1);
      if (!line_.empty()) return true;
    }
    return false;
  }

  std::size_t read_count() {
    if (!next_line()) throw file_error(ErrorKind::kMalformed, file_.name, "expected the number of photos, got nothing");
    const std::optional<std::size_t> count = number_in<std::size_t>(line_);
    if (!count || *count > kMostPhotos)
      fail("expected the number of photos, up to " + std::to_string(kMostPhotos) + ", got '" + excerpt(line_) + "'");
    return *count;
  }

  // Takes the last word off the line.
  double number() {
    const std::size_t space = line_.find_last_of(kBlank), first = space == std::string::npos ? 0 : space + 1;
    const auto value = number_in<double>(std::string_view(line_).substr(first + (line_[first] == '+')));
    if (!value || !std::isfinite(*value)) fail("expected a file name and three numbers, got '" + excerpt(line_) + "'");
    line_.erase(space == std::string::npos ? 0 : line_.find_last_not_of(kBlank, space) + 1);
    if (line_.empty()) fail("expected a file name before three numbers, got none");
    return *value;
  }

  LitPhoto photo() {
    Vec3d light;
    light.z = number(), light.y = number(), light.x = number();
    if (!(length(light) > 1e-6)) fail("expected a direction, got a vector of no length");
    if (!std::isfinite(length(light))) fail("expected a direction, got a vector whose length no number holds");
    if (!(light.z > 0)) fail("expected a light above the surface, got z = " + number_text(light.z));
    const auto directory = std::filesystem::path(file_.name).parent_path();
    return {(directory / line_).lexically_normal().string(), normalized(light)};
  }

  FileRef file_;
  std::istringstream in_;
  std::string line_;
  int number_ = 0;
};

}  // namespace

std::vector<LitPhoto> read_light_list(const FileRef& file) {
  require_readable(file);
  return ListReader(file).read();
}

}  // namespace burnish
