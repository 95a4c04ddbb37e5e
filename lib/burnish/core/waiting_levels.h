// The levels of a mip chain beyond its base, which a file takes only after it: their rows wait in a temporary file.
#pragma once

#include <cstddef>
#include <vector>

#include "burnish/core/file_ref.h"
#include "burnish/core/spill_file.h"

namespace burnish {

class WaitingLevels {
 public:
  // Of a chain of so many levels, the base's included, to `file`, beside which they wait. kIo as SpillFile.
  WaitingLevels(const FileRef& file, int width, int height, int levels, std::size_t texel_bytes);

  // The next rows of a level from 1 on; levels may take turns.
  void append(int level, int count, const void* rows);
  // Rows [first, first + count) of a level, which have been appended.
  void read(int level, int first, int count, void* rows) const;

 private:
  struct Level {
    std::size_t row_bytes, begin, end;  // bytes of a row; where its rows are in the file, and the next one will be
  };
  SpillFile spilled_;
  std::vector<Level> levels_;  // from 1 on
};

}  // namespace burnish
