// .ptm files (Malzbender & Gelb, "Polynomial texture map (.ptm) file format", version 1.2, 2001).
//
//   PTM_1.2
//   PTM_FORMAT_LRGB, PTM_FORMAT_RGB, PTM_FORMAT_JPEG_LRGB or PTM_FORMAT_JPEG_RGB
//   width, height, six scales, six biases: text, in any number of lines when read
//   bytes, bottom row first: LRGB six a texel of the whole image, then R, G, B of it (1.0 and 1.1: nine a texel);
//   RGB six a texel of the red image, of the green, of the blue; JPEG_…: jpeg_planes.h
#pragma once

#include <string>

#include "burnish/core/file_ref.h"
#include "burnish/ptm/ptm.h"

namespace burnish {

struct PtmFile : PtmBytes {
  std::string format;  // "PTM_1.2 LRGB"
};

// Whether it begins as one does. kIo where it cannot be read.
bool is_ptm(const FileRef& file);
// kIo where it cannot be read, kMalformed for what is no such file, ends early, says sizes that it does not hold,
// has coefficients beyond floats or contradicts itself; kUnsupported, by name, for the other formats.
PtmFile read_ptm(const FileRef& file);
// 1.2; in JPEG planes of that quality, 1 … 100, raw where it is 0. kIo where it cannot be written.
void write_ptm(const FileRef& file, const PtmBytes& ptm, int jpeg_quality = 0);

}  // namespace burnish
