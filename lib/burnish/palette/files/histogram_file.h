// What maps hold (NormalCounts) as a file, to be added up with others later.
//
//   "burnish-histogram 1\n"
//   uint64, little-endian: the size of what follows when it is inflated
//   a zlib stream (RFC 1950) of numbers, 7 bits a byte, the lowest first, a bit above them where more follow (LEB128):
//     space of the normals: 0 where the maps do not say, 1 tangent, 2 object
//     0 (exact), n, then of each of n keys in ascending order the step from the one before, of each the texels that
//       count, of each those that are masked out
//     1 (bins), shift, invalid texels, n, then of each of n bins in ascending order the step of the key, of each the
//       texels, of each x, y and z of the sum, less what as many normals of the bin's middle sum up to (zigzag)
//
// Keys are NormalCounts' and NormalBins'. A file means the same wherever it came from: coding, materials and masks are
// in it.
#pragma once

#include <optional>

#include "burnish/core/file_ref.h"
#include "burnish/normal/normal_space.h"
#include "burnish/palette/normal_counts.h"

namespace burnish {

struct HistogramFile {
  NormalCounts counts;
  std::optional<NormalSpace> space;  // none where the maps do not say
};

// kIo where it cannot be read; kMalformed for what is no such file, ends early, goes on, or says what no maps hold;
// kUnsupported for another version.
HistogramFile read_histogram(const FileRef& file);
// kIo where it cannot be written.
void write_histogram(const FileRef& file, const HistogramFile& histogram);

}  // namespace burnish
