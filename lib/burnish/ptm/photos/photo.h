// A photograph of a capture, read row by row from the top as red, green and blue.
//
// Of more channels than three the first three are taken, of one or two the first for all. JPEG is decoded by
// libjpeg with its defaults, everything else by ImageReader. Samples of 8 bits come as they are; others as floats, of
// which 255 is the largest integer, and 1 in files of floats.
#pragma once

#include <cstdint>
#include <memory>

#include "burnish/core/file_ref.h"

namespace burnish {

struct PhotoForm {
  int width = 0, height = 0;
  bool bytes = true;   // 8-bit samples
  bool whole = false;  // the first row takes the memory of all: progressive JPEG, interlaced PNG
};

class Photo {
 public:
  virtual ~Photo() = default;
  const PhotoForm& form() const { return form_; }

  // The next `rows`, 3 · width samples each; `read` of what form() says only. kMalformed where the file is damaged or
  // cut short, also where the codec makes something up for what is missing.
  virtual void read(int rows, std::uint8_t* rgb) = 0;
  virtual void read(int rows, float* rgb) = 0;

 protected:
  PhotoForm form_;
};

// kIo where the file cannot be read, kMalformed where it is no image, kUnsupported where its colours are not red,
// green and blue, or grey.
std::unique_ptr<Photo> open_photo(const FileRef& file);

namespace detail {
bool is_jpeg(const FileRef& file);
std::unique_ptr<Photo> open_jpeg_photo(const FileRef& file);
std::unique_ptr<Photo> open_image_photo(const FileRef& file);
}  // namespace detail

}  // namespace burnish
