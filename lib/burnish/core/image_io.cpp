#include "burnish/core/image_io.h"

#include "burnish/core/error.h"

namespace burnish {

Image read_image(const FileRef& file) { return ImageReader(file).read_level(0); }

void write_image(const FileRef& file, FileType type, SampleType sample, const Image& image,
                 const Attributes& attributes) {
  ImageWriter writer(file, type, sample, image.width, image.height, image.channels, attributes);
  writer.write_rows(image.height, image.data.data());
  writer.close();
}

ByteImage read_ids(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  if (reader.channels() != 1)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected 1 channel of material ids, got " + std::to_string(reader.channels()));
  if (!reader.has_exact_samples() || reader.sample_type() != SampleType::kUint8)
    throw file_error(ErrorKind::kMalformed, file.name,
                     std::string("expected material ids as uint8, got ") + burnish::name(reader.sample_type()));
  reader.require_size(width, height, "the normal map");
  ByteImage ids(width, height);
  reader.read_rows_stored(0, height, ids.data.data());
  return ids;
}

ByteImage read_mask(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  reader.require_size(width, height, "the map it masks");
  ByteImage mask(width, height);
  std::vector<float> row(std::size_t(width) * reader.channels());
  for (int y = 0; y < height; y++) {
    reader.read_rows(y, 1, row.data());
    for (int x = 0; x < width; x++) mask.row(y)[x] = row[std::size_t(x) * reader.channels()] != 0.f;
  }
  return mask;
}

}  // namespace burnish
