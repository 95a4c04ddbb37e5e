#include "burnish/normal/height_texels.h"

#include "burnish/core/error.h"
#include "burnish/core/lower_case.h"
#include "burnish/core/wording.h"

namespace burnish {

namespace {

int channel_of(const ImageReader& reader, const std::string& wanted) {
  if (wanted.empty()) return 0;
  const std::vector<std::string>& names = reader.channel_names();
  for (std::size_t i = 0; i < names.size(); i++)
    if (lower_case(names[i]) == lower_case(wanted)) return int(i);
  if (wanted.find_first_not_of("0123456789") == std::string::npos && wanted.size() < 5 &&
      std::stoi(wanted) < reader.channels())
    return std::stoi(wanted);
  throw file_error(ErrorKind::kMalformed, reader.name(), "expected channel " + wanted + ", got " + joined(names));
}

}  // namespace

HeightChannel::HeightChannel(const ImageReader& reader, const std::string& wanted)
    : channels_(reader.channels()), channel_(channel_of(reader, wanted)), is_chosen_(!wanted.empty()) {}

void HeightChannel::take(const float* samples, std::size_t texels, float* heights) {
  for (std::size_t i = 0; i < texels; i++) heights[i] = samples[i * channels_ + channel_];
  if (channels_ < 3 || is_chosen_ || colours_differ_) return;
  for (std::size_t i = 0; i < texels; i++) {
    const float* texel = samples + i * channels_;
    if (texel[0] != texel[1] || texel[0] != texel[2]) colours_differ_ = true;
  }
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
