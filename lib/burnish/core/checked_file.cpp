#include "burnish/core/checked_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace burnish {

CheckedFile::CheckedFile(const std::string& path) : file_(std::fopen(path.c_str(), "w+be")) {
  note_error(file_ != nullptr);
  if (file_) std::setvbuf(file_, nullptr, _IOFBF, 1 << 18);
}

void CheckedFile::close() {
  if (file_) note_error(std::fclose(file_) == 0);
  file_ = nullptr;
}

std::size_t CheckedFile::write(const void* bytes, std::size_t size) {
  if (!to_position()) return 0;
  const std::size_t n = std::fwrite(bytes, 1, size, file_);
  note_error(n == size);
  at_ = position_ += std::int64_t(n);
  return n;
}

std::size_t CheckedFile::read(void* bytes, std::size_t size) {
  at_ = -1;  // between writing and reading C wants a seek
  if (!to_position()) return 0;
  const std::size_t n = std::fread(bytes, 1, size, file_);
  position_ += std::int64_t(n);
  at_ = -1;
  return n;
}

std::size_t CheckedFile::size() const {
  struct stat st;
  return file_ && std::fflush(file_) == 0 && ::fstat(::fileno(file_), &st) == 0 ? std::size_t(st.st_size) : 0;
}

Error CheckedFile::error(const std::string& name, const std::string& codec_message) const {
  const std::string what = error_ ? std::strerror(error_) : codec_message;
  return file_error(ErrorKind::kIo, name, "cannot be written: " + (what.empty() ? "the codec does not say why" : what));
}

bool CheckedFile::to_position() {
  if (!file_) return false;
  if (at_ != position_) note_error(::fseeko(file_, position_, SEEK_SET) == 0);
  at_ = position_;
  return true;
}

void CheckedFile::note_error(bool ok) {
  if (!ok && !error_) error_ = errno ? errno : EIO;
}

}  // namespace burnish
