// A file that is written and remembers what went wrong first.
//
// Codecs swallow errors, above all those that only closing reveals: whoever hands them this file can ask it afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "burnish/core/error.h"

namespace burnish {

class CheckedFile {
 public:
  explicit CheckedFile(const std::string& path);  // replaces what is there
  ~CheckedFile() { close(); }
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  // At the position, which they advance; how many bytes were written or read.
  std::size_t write(const void* bytes, std::size_t size);
  std::size_t read(void* bytes, std::size_t size);
  std::int64_t position() const { return position_; }
  void seek(std::int64_t position) { position_ = position; }
  std::size_t size() const;
  bool is_open() const { return file_ != nullptr; }
  void close();

  // errno of the first failure, or 0.
  int first_error() const { return error_; }
  // kIo for a file of that name, by the first failure; otherwise with what the codec says.
  Error error(const std::string& name, const std::string& codec_message = "") const;

 private:
  bool to_position();
  void note_error(bool ok);

  std::FILE* file_;
  std::int64_t position_ = 0;
  std::int64_t at_ = 0;  // where file_ stands; −1 where C wants a seek first
  int error_ = 0;
};

}  // namespace burnish
