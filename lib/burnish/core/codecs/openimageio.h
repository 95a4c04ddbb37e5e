// What the module burnish-openimageio.so gives to the program that loads it: the image types that PNG and EXR are not,
// by OpenImageIO. It is loaded when the first such file is opened, since OpenImageIO and the hundreds of libraries
// behind it take a quarter of a second.
#pragma once

#include <memory>
#include <string>

#include "burnish/core/codecs/image_sink.h"
#include "burnish/core/codecs/image_source.h"

namespace burnish::detail {

struct OpenImageIo {
  // `codec` as OpenImageIO calls it; `threads` is how many it may use.
  std::unique_ptr<ImageSource> (*open)(const FileRef& file, const std::string& codec, int threads);
  std::unique_ptr<ImageSink> (*create)(const FileRef& file, FileType type, const ImageShape& shape, int threads);
};

// The name of that symbol, which the module has.
constexpr const char* kOpenImageIoSymbol = "burnish_openimageio";

}  // namespace burnish::detail
