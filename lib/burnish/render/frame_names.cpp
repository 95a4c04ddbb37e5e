#include "burnish/render/frame_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "burnish/core/error.h"

namespace burnish {
namespace {

// Length of the %d or %0Nd (N of one digit) at a position, or 0.
std::size_t number_at(const std::string& s, std::size_t i) {
  if (s.compare(i, 2, "%d") == 0) return 2;
  return s.compare(i, 2, "%0") == 0 && i + 3 < s.size() && std::isdigit(static_cast<unsigned char>(s[i + 2])) &&
                 s[i + 3] == 'd'
             ? 4
             : 0;
}

}  // namespace

FrameNames::FrameNames(const std::string& pattern, int frames, const std::vector<Aov>& aovs)
    : before_(pattern), aovs_(aovs) {
  if (frames > 1 && pattern != "-") {
    for (std::size_t i = 0; i < pattern.size(); i++) {
      const std::size_t length = number_at(pattern, i);
      if (length == 0) continue;
      if (digits_ >= 0) throw Error(ErrorKind::kUsage, "'" + pattern + "': expected one number of a frame, got two");
      digits_ = length == 4 ? pattern[i + 2] - '0' : 1;
      before_ = pattern.substr(0, i);
      after_ = pattern.substr(i + length);
    }
    if (digits_ < 0)
      throw Error(ErrorKind::kUsage, "'" + pattern + "': expected %d or %04d for the numbers of several frames");
  }
  if (pattern == "-" && (frames > 1 || !aovs.empty()))
    throw Error(ErrorKind::kUsage, "output: standard output takes one picture; name a file");
  if (std::size_t(frames) * (1 + aovs.size()) > kMostFrameFiles)
    throw Error(ErrorKind::kUsage, "frames: expected at most " + std::to_string(kMostFrameFiles) +
                                       " files in one run, got " +
                                       std::to_string(std::size_t(frames) * (1 + aovs.size())));
}

std::vector<std::string> FrameNames::of_frame(int index) const {
  std::string number = digits_ < 0 ? "" : std::to_string(index);
  if (int(number.size()) < digits_) number.insert(0, std::size_t(digits_) - number.size(), '0');
  std::vector<std::string> out{before_ + number + after_};
  const std::filesystem::path picture(out[0]);
  for (Aov aov : aovs_)
    out.push_back((picture.parent_path() / (picture.stem().string() + "." + name(aov) + ".exr")).string());
  return out;
}

}  // namespace burnish
