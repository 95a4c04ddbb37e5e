// Files read and written in one piece: text, and what is parsed in memory.
#pragma once

#include <string>
#include <string_view>

#include "burnish/core/file_ref.h"

namespace burnish {

// kIo where it cannot be read; kMalformed for more than `most` bytes; kUnsupported for more than the machine has.
std::string read_file(const FileRef& file, std::size_t most = std::size_t(1) << 30);
// kIo where it cannot be written.
void write_file(const FileRef& file, std::string_view bytes);

}  // namespace burnish
