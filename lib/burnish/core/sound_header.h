// What codecs take on trust: they set memory aside for whatever sizes a file's header says, some as they open it.
#pragma once

#include "burnish/core/file_ref.h"

namespace burnish {

// To be asked before a codec opens a file; all else that may be wrong is left to that. kMalformed
//
//   EXR  where an attribute is larger than what is left of the file, or of another size than its type, or where a row
//        or a tile has more texels than deflate can pack into the file
//   PNG  where a chunk but of texels is larger than what is left of the file
//   BMP  where there are more texels than run-length codes can pack into the file
//   PNM  where the file is larger than memory, kUnsupported
//
// BMP, PNM and JPEG, which may be unpacked as they are opened, are held against the limit of texel_limit.h too.
void require_sound_header(const FileRef& file);

}  // namespace burnish
