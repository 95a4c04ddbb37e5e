#include "burnish/core/whole_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "burnish/core/error.h"
#include "burnish/core/physical_memory.h"

namespace burnish {

std::string read_file(const FileRef& file, std::size_t most) {
  require_readable(file);
  const auto require_fitting = [&](std::uintmax_t size) {
    if (size > most)
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected at most " + std::to_string(most) + " bytes, got more");
    require_memory_for(file.name, size);
  };
  std::error_code is_pipe;
  if (const std::uintmax_t size = std::filesystem::file_size(file.path, is_pipe); !is_pipe) require_fitting(size);
  std::ifstream in(file.path, std::ios::binary);
  std::string bytes;
  char piece[1 << 16];
  while (in.read(piece, sizeof piece), in.gcount() > 0) {
    bytes.append(piece, std::size_t(in.gcount()));
    require_fitting(bytes.size());
  }
  if (!in.is_open() || in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return bytes;
}

void write_file(const FileRef& file, std::string_view bytes) {
  errno = 0;
  std::ofstream out(file.path, std::ios::binary);
  if (!out.write(bytes.data(), std::streamsize(bytes.size())) || !out.flush())
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace burnish
