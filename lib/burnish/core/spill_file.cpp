#include "burnish/core/spill_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "burnish/core/error.h"

namespace burnish {
namespace {

std::string spill_directory(const std::string& directory) {
  const char* named = std::getenv("TMPDIR");
  if (named && *named) return named;
  return directory.empty() ? "." : directory;
}

// Where the file system knows no files without names, one whose name goes at once.
int open_unnamed(const std::string& directory) {
  if (const int file = ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600); file >= 0) return file;
  std::string path = directory + "/.burnish-spill.XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(path.c_str());
  return file;
}

// A call of `some(at, left)` may move fewer bytes than asked for.
template <typename Some>
void move_all(const std::string& directory, std::size_t at, std::size_t size, const Some& some) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = some(at + done, done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw file_error(ErrorKind::kIo, directory,
                       std::string("a temporary file in it fails: ") + std::strerror(n == 0 ? EIO : errno));
    done += std::size_t(n);
  }
}

}  // namespace

SpillFile::SpillFile(const std::string& directory)
    : directory_(spill_directory(directory)), file_(open_unnamed(directory_)) {
  if (file_ < 0)
    throw file_error(ErrorKind::kIo, directory_, std::string("cannot hold a temporary file: ") + std::strerror(errno));
}

SpillFile::~SpillFile() { ::close(file_); }

void SpillFile::write(std::size_t at, const void* bytes, std::size_t size) {
  move_all(directory_, at, size, [&](std::size_t place, std::size_t done, std::size_t left) {
    return ::pwrite(file_, static_cast<const char*>(bytes) + done, left, off_t(place));
  });
}

void SpillFile::read(std::size_t at, void* bytes, std::size_t size) const {
  move_all(directory_, at, size, [&](std::size_t place, std::size_t done, std::size_t left) {
    return ::pread(file_, static_cast<char*>(bytes) + done, left, off_t(place));
  });
}

}  // namespace burnish
