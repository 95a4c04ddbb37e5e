// Photographs of one surface from one place, under different lights, read together: a band of rows of all of them at a
// time, so that memory does not grow with their height.
//
// Photographs that only come whole are decoded once, one or two at a time, to a temporary file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "burnish/core/file_ref.h"
#include "burnish/core/progress.h"
#include "burnish/core/spill_file.h"
#include "burnish/ptm/photos/photo.h"

namespace burnish {

// Rows of all photographs: those of each, R G B a texel, every `stride` samples, rounded up so that whole blocks of
// kBlockTexels may be read. In bytes where all photographs have them, otherwise in floats; the other is empty.
struct PhotoBand {
  static constexpr std::size_t kBlockTexels = 64;
  int first = 0, rows = 0;
  std::size_t stride = 0;
  std::vector<std::uint8_t> bytes;
  std::vector<float> floats;
};

class Capture {
 public:
  // Opens every photograph once. Errors are those of open_photo; kMalformed where sizes differ. `memory`: bytes that
  // bands and decoders may take, as far as they can do with it; `directory`: for a temporary file (spill_file.h).
  Capture(std::vector<FileRef> photos, std::size_t memory, const std::string& directory);

  int count() const { return int(photos_.size()); }
  int width() const { return width_; }
  int height() const { return height_; }
  bool bytes() const { return bytes_; }

  // All rows, in ascending bands; while the caller works on one, threads that are free decode the next. May be
  // repeated.
  void for_each_band(const std::function<void(const PhotoBand&)>& work, const Progress& progress) const;

 private:
  struct Source {
    FileRef file;
    PhotoForm form;
    std::size_t spilled_at = 0;  // of those that come whole
  };
  void spill(std::size_t memory, const std::string& directory);
  std::size_t row_bytes(const Source& s) const { return std::size_t(width_) * 3 * (s.form.bytes ? 1 : sizeof(float)); }
  void read(const Source& source, Photo* photo, int first, int rows, std::uint8_t* bytes, float* floats) const;

  std::vector<Source> photos_;
  int width_ = 0, height_ = 0, band_rows_ = 1;
  bool bytes_ = true;
  std::optional<SpillFile> spilled_;
};

}  // namespace burnish
