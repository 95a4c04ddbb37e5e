// A lookup table as a C header, for programs that have it compiled in.
//
//   enum { burnish_ward_e_width = 256, burnish_ward_e_height = 256, burnish_ward_e_channels = 1 };
//   static const float burnish_ward_e[256 * 256 * 1] = {…};
//
// Row by row, the channels of a texel together, in C99 and C++. uint8 and uint16 hold value / scale, half its bits in
// uint16_t. A comment says what the attributes of image files do (table_file.h).
#pragma once

#include "burnish/brdf/tables/table_file.h"

namespace burnish {

// kUnsupported where the samples cannot hold the values.
void write_table_header(const FileRef& file, SampleType sample, const TableFile& table);

}  // namespace burnish
