// What JPEG_LRGB and JPEG_RGB maps hold behind their biases: a grey JPEG for each byte of a texel.
//
//   quality, then for each of n = 9 or 18 planes transforms, motion in x, motion in y, order, reference plane (−1:
//   none), size of its JPEG, size of its side information: text
//   each plane's JPEG and side information, the planes being a₀ … a₅, then R, G, B or a₀ … a₅ of green and of blue
//
// Planes are put together in their `order`. One with a reference is what its JPEG holds plus the reference − 128, or
// plus 255 − the reference − 128 where bit 0 of its transforms is set, modulo 256. Then its side information, records
// of a big-endian offset of four bytes and one byte, replaces single texels. Bottom row first.
#pragma once

#include <string>

#include "burnish/ptm/files/header_text.h"
#include "burnish/ptm/ptm.h"

namespace burnish {

// Fills `out`, whose shape is known; the header stands behind the biases. In parallel. kMalformed for what contradicts
// itself or is damaged; kUnsupported for motion (bit 1 of transforms), which no published program writes or reads.
void read_jpeg_planes(HeaderText& header, PtmBytes& out);

// The same, to write, in the order of their numbers and without references. `name` is for messages; kUnsupported for
// sides beyond JPEG's.
//
// What one plane loses the next make up for: colours come first, and light is scaled to what is left of them; then a
// polynomial's planes, each holding what is best of its coefficient now that those before it are known, for lights
// uniform over the hemisphere (light_matrix.h). Frequencies are rounded to multiples of 16 · (2 − quality/50), of the
// whole number below it, and not below 1, where libjpeg's tables begin with that and rise.
std::string jpeg_planes(const PtmBytes& ptm, int quality, const std::string& name);

}  // namespace burnish
