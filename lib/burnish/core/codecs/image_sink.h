// A codec's side of ImageWriter: an image file that is being written, whatever its type.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/attributes.h"
#include "burnish/core/file_type.h"

namespace burnish::detail {

struct ImageShape {
  int width, height;
  std::vector<std::string> channel_names;
  SampleType sample;
  Attributes attributes;  // texts and numbers, as the file is to hold them

  int channels() const { return int(channel_names.size()); }
};

// R, G, B, A; Y where there is one channel.
inline std::vector<std::string> usual_names(int channels) {
  if (channels == 1) return {"Y"};
  std::vector<std::string> names;
  for (int c = 0; c < channels; c++) names.push_back(c < 4 ? std::string(1, "RGBA"[c]) : "channel" + std::to_string(c));
  return names;
}

class ImageSink {
 public:
  virtual ~ImageSink() = default;
  // The next rows, in the file's samples. kIo where they cannot be written.
  virtual void write_rows(int count, const void* rows) = 0;
  // Must be called: reports what only closing can reveal.
  virtual void close() = 0;
};

}  // namespace burnish::detail
