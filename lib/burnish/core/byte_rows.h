// Material ids and masks out of image files, row by row.
//
// Files of moderate size are decoded once, however often their rows are read; of larger ones little is held.
#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/image_io.h"

namespace burnish {

class ByteRows {
 public:
  // Ids: one channel, 8-bit, unscaled. kMalformed where the file is anything else, or not of that size.
  static ByteRows of_ids(const FileRef& file, int width, int height);
  // Whether the first channel differs from 0. kMalformed where the size differs.
  static ByteRows of_mask(const FileRef& file, int width, int height);

  // Rows [first, first + count); in any order, ascending is fast.
  void read(int first, int count, std::uint8_t* out);

 private:
  enum class Kind { kIds, kMask };
  ByteRows(ImageReader file, Kind kind);
  void decode(int first, int count, std::uint8_t* out);

  ImageReader file_;
  Kind kind_;
  bool keep_;
  std::vector<std::uint8_t> kept_;  // the rows read so far, where they are kept
};

}  // namespace burnish
