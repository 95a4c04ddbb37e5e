// Image files in and out, in bands of rows, with data kept as data.
//
// PNG is read and written by libpng, EXR by OpenEXR, all other types by OpenImageIO, which a module brings along when
// the first of them is opened (codecs/openimageio.h; kIo where it is not installed). Samples are never
// colour-converted, multiplied by alpha or rotated; integers read as floats are divided by their maximum, floats are
// taken as they are. Writers put no clock and no path into a file. Errors: kIo where a file is missing, a directory,
// unreadable or unwritable; kMalformed where its content is damaged or of no known type; kUnsupported where it is valid
// but beyond what is read here: volumes, deep images, data windows that are not the whole image.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/attributes.h"
#include "burnish/core/file_ref.h"
#include "burnish/core/file_type.h"
#include "burnish/core/image.h"

namespace burnish {

class ImageReader {
 public:
  explicit ImageReader(const FileRef& file);
  ~ImageReader();
  ImageReader(ImageReader&&) noexcept;

  int width() const;
  int height() const;
  int channels() const;
  bool integer() const;            // stored as integers, read as [0, 1]
  SampleType sample_type() const;  // nearest of the four; other integers count as uint16
  const std::vector<std::string>& channel_names() const;
  const std::string& name() const;  // for messages
  // What the file says beside its texels (attributes.h); none where it does not. JSON is text here. Numbers: none too
  // where it says something else.
  std::optional<std::string> text(const std::string& attribute) const;
  std::optional<std::vector<double>> numbers(const std::string& attribute) const;
  std::size_t file_bytes() const;  // of the pixels, uncompressed, as stored
  bool has_exact_samples() const;  // the file stores exactly sample_type()

  // Rows [first, first + count) of all channels, interleaved, as float. Rows may be read in any order; ascending is
  // fast.
  void read_rows(int first, int count, float* out);
  // The stored samples without conversion, size as sample_type(); only where has_exact_samples().
  void read_rows_stored(int first, int count, void* out);

  // Of a mip chain; 1 for other files. The functions above speak of level 0, the base.
  int levels() const;
  // All texels of a level, whatever its size. kUnsupported where memory does not hold them.
  Image read_level(int level);

  // kMalformed unless the image has that size; `what` names the other image.
  void require_size(int width, int height, const std::string& what) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class ImageWriter {
 public:
  // Writes to file.path; messages speak of file.name. Without names channels are R, G, B, A, or Y where there is one.
  ImageWriter(const FileRef& file, FileType type, SampleType sample, int width, int height, int channels,
              const Attributes& attributes = {}, const std::vector<std::string>& channel_names = {});
  ~ImageWriter();
  ImageWriter(ImageWriter&&) noexcept;

  // The next `count` rows. Floats are converted to the file's samples: integers by round half up of the clamped value.
  void write_rows(int count, const float* rows);
  // Samples already in the file's own type.
  void write_rows_stored(int count, const void* rows);
  // Must be called: reports what only closing can reveal.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Whole images.
Image read_image(const FileRef& file);
void write_image(const FileRef& file, FileType type, SampleType sample, const Image& image,
                 const Attributes& attributes = {});
// One channel, 8-bit, unscaled: material ids. kMalformed where the file is anything else.
ByteImage read_ids(const FileRef& file, int width, int height);
// One value a texel: whether the first channel differs from 0. kMalformed where the size differs.
ByteImage read_mask(const FileRef& file, int width, int height);

// "OpenImageIO 2.4.7, OpenEXR 3.1.5, libpng 1.6.39, zlib 1.2.13", for --version.
std::string codec_versions();

}  // namespace burnish
