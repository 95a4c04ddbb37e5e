#include "burnish/core/codecs.h"

#include "burnish/core/image_io.h"

namespace burnish {
namespace detail {

OIIO::TypeDesc to_oiio(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::kUint16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::kHalf:
      return OIIO::TypeDesc::HALF;
    default:
      return OIIO::TypeDesc::FLOAT;
  }
}

const char* codec_of(FileType type) {
  switch (type) {
    case FileType::kPng:
      return "png";
    case FileType::kTga:
      return "targa";
    case FileType::kBmp:
      return "bmp";
    case FileType::kTiff:
      return "tiff";
    case FileType::kExr:
      return "openexr";
    default:
      return "";
  }
}

}  // namespace detail

void set_codec_threads(int threads) {
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads == 0 ? 0 : threads == 1 ? -1 : threads);
}

std::string codec_version() {
  return "OpenImageIO " + std::to_string(OIIO_VERSION_MAJOR) + "." + std::to_string(OIIO_VERSION_MINOR) + "." +
         std::to_string(OIIO_VERSION_PATCH);
}

}  // namespace burnish
