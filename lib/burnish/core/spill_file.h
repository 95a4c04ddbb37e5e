// Memory on disk: a temporary file without a name, which goes with its owner, however that ends.
#pragma once

#include <cstddef>
#include <string>

namespace burnish {

class SpillFile {
 public:
  // In the folder that the environment names as TMPDIR, otherwise in `directory`. kIo where none can be made.
  explicit SpillFile(const std::string& directory);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  // At any place, from many threads. kIo where the disk is full or fails.
  void write(std::size_t at, const void* bytes, std::size_t size);
  void read(std::size_t at, void* bytes, std::size_t size) const;

 private:
  std::string directory_;
  int file_;
};

}  // namespace burnish
