#include "burnish/core/file_ref.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "burnish/core/error.h"

namespace burnish {

void require_readable(const FileRef& file) {
  struct stat st;
  if (::stat(file.path.c_str(), &st) != 0)
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(st.st_mode)) throw file_error(ErrorKind::kIo, file.name, "expected a file, got a directory");
  if (!std::ifstream(file.path, std::ios::binary))
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be read: ") + std::strerror(errno));
}

}  // namespace burnish
