#include "burnish/normal/height_texels.h"

#include <algorithm>
#include <cctype>

#include "burnish/core/error.h"

namespace burnish {

int height_channel(const ImageReader& reader, const std::string& wanted) {
  if (wanted.empty()) return 0;
  const std::vector<std::string>& names = reader.channel_names();
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  for (std::size_t i = 0; i < names.size(); i++)
    if (std::ranges::equal(names[i], wanted, {}, lower, lower)) return int(i);
  if (wanted.find_first_not_of("0123456789") == std::string::npos && wanted.size() < 5 &&
      std::stoi(wanted) < reader.channels())
    return std::stoi(wanted);
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
  throw file_error(ErrorKind::kMalformed, reader.name(), "expected channel " + wanted + ", got " + all);
}

int wrapped_texel(int i, int n, Wrap wrap) {
  if (i >= 0 && i < n) return i;
  switch (wrap) {
    case Wrap::kFit:
      return -1;
    case Wrap::kClamp:
      return i < 0 ? 0 : n - 1;
    case Wrap::kRepeat:
      return ((i % n) + n) % n;
    case Wrap::kMirror: {
      const int m = ((i % (2 * n)) + 2 * n) % (2 * n);
      return m < n ? m : 2 * n - 1 - m;
    }
  }
  return -1;
}

}  // namespace burnish
