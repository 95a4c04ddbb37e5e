#include "burnish/core/image_io.h"

#include "burnish/core/byte_rows.h"

namespace burnish {

Image read_image(const FileRef& file) { return ImageReader(file).read_level(0); }

void write_image(const FileRef& file, FileType type, SampleType sample, const Image& image,
                 const Attributes& attributes) {
  ImageWriter writer(file, type, sample, image.width, image.height, image.channels, attributes);
  writer.write_rows(image.height, image.data.data());
  writer.close();
}

ByteImage read_ids(const FileRef& file, int width, int height) {
  ByteRows rows = ByteRows::of_ids(file, width, height);
  ByteImage ids(width, height);
  rows.read(0, height, ids.data.data());
  return ids;
}

ByteImage read_mask(const FileRef& file, int width, int height) {
  ByteRows rows = ByteRows::of_mask(file, width, height);
  ByteImage mask(width, height);
  rows.read(0, height, mask.data.data());
  return mask;
}

}  // namespace burnish
