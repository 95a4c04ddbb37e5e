// .ptm files (Malzbender & Gelb, "Polynomial texture map (.ptm) file format", version 1.2, 2001).
//
//   PTM_1.2
//   PTM_FORMAT_LRGB or PTM_FORMAT_RGB
//   width, height, six scales, six biases: text, in any number of lines when read
//   bytes, bottom row first: LRGB six a texel of the whole image, then R, G, B of it (1.0 and 1.1: nine a texel);
//   RGB six a texel of the red image, of the green, of the blue
#pragma once

#include <string>

#include "burnish/core/file_ref.h"
#include "burnish/ptm/ptm.h"

namespace burnish {

struct PtmFile : PtmBytes {
  std::string format;  // "PTM_1.2 LRGB"
};

// kIo where it cannot be read, kMalformed for what is no such file, ends early or says sizes that it does not hold;
// kUnsupported, by name, for the other formats.
PtmFile read_ptm(const FileRef& file);
// 1.2. kIo where it cannot be written.
void write_ptm(const FileRef& file, const PtmBytes& ptm);

}  // namespace burnish
