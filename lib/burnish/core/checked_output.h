// An image file that OpenImageIO writes and whose every failure is seen.
//
// Most of its codecs look at no result of their own writes: a full disk would pass unseen.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>

#include "burnish/core/attributes.h"
#include "burnish/core/file_ref.h"
#include "burnish/core/file_type.h"

namespace burnish::detail {

class CheckedProxy;

class CheckedOutput {
 public:
  // kUnsupported where nothing writes that type; kIo where the file cannot be made.
  CheckedOutput(const FileRef& file, FileType type);
  ~CheckedOutput();

  // What every image written here has: one channel named Y, zip, alpha as it is, no clock, the attributes.
  OIIO::ImageSpec spec(SampleType sample, int width, int height, int channels, const Attributes& attributes) const;
  void open(OIIO::ImageSpec spec, OIIO::ImageOutput::OpenMode mode = OIIO::ImageOutput::Create);
  OIIO::ImageOutput& image() { return *image_; }
  // Throws, kIo, what went wrong, if anything did.
  void require(bool ok);
  // Must be called: reports what only closing can reveal.
  void close();

 private:
  FileRef file_;
  FileType type_;
  std::unique_ptr<CheckedProxy> to_;  // outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> image_;
};

}  // namespace burnish::detail
