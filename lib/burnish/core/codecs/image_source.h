// A codec's side of ImageReader: an image file that is open, whatever its type.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "burnish/core/attributes.h"
#include "burnish/core/error.h"
#include "burnish/core/file_ref.h"
#include "burnish/core/file_type.h"

namespace burnish::detail {

struct ImageForm {
  int width = 0, height = 0;
  std::vector<std::string> channel_names;
  SampleType sample = SampleType::kUint8;  // nearest of the four
  bool integer = true;
  bool exact = true;            // all channels are stored as just that
  std::size_t texel_bytes = 0;  // as stored
  Attributes attributes;        // texts and numbers; of two with one name the last holds

  int channels() const { return int(channel_names.size()); }
};

struct LevelSize {
  int width, height;
};

class ImageSource {
 public:
  virtual ~ImageSource() = default;
  const ImageForm& form() const { return form_; }

  // As ImageReader's.
  virtual void read_rows(int first, int count, float* out) = 0;
  virtual void read_rows_stored(int first, int count, void* out) = 0;
  virtual int levels() { return 1; }
  // Of a level from 1 on, with as many channels as the base.
  virtual LevelSize level_size(int) { return {0, 0}; }
  virtual void read_level(int, float*) {}

 protected:
  ImageForm form_;
};

// kUnsupported where the texels that a file holds are not those of the whole image.
inline void require_whole(const FileRef& file, bool whole, LevelSize texels, LevelSize image) {
  if (whole) return;
  throw file_error(ErrorKind::kUnsupported, file.name,
                   "expected the data window to be the whole image, got " + std::to_string(texels.width) + "x" +
                       std::to_string(texels.height) + " texels of " + std::to_string(image.width) + "x" +
                       std::to_string(image.height));
}

}  // namespace burnish::detail
