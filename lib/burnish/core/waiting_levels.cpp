#include "burnish/core/waiting_levels.h"

#include <filesystem>

#include "burnish/core/mip.h"

namespace burnish {

WaitingLevels::WaitingLevels(const FileRef& file, int width, int height, int levels, std::size_t texel_bytes)
    : spilled_(std::filesystem::path(file.path).parent_path().string()) {
  std::size_t at = 0;
  for (int l = 1; l < levels; l++) {
    const std::size_t row_bytes = texel_bytes * level_size(width, l);
    levels_.push_back({row_bytes, at, at});
    at += row_bytes * level_size(height, l);
  }
}

void WaitingLevels::append(int level, int count, const void* rows) {
  Level& to = levels_[level - 1];
  spilled_.write(to.end, rows, to.row_bytes * count);
  to.end += to.row_bytes * count;
}

void WaitingLevels::read(int level, int first, int count, void* rows) const {
  const Level& from = levels_[level - 1];
  spilled_.read(from.begin + from.row_bytes * first, rows, from.row_bytes * count);
}

}  // namespace burnish
