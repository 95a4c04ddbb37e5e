// The nearest texel that has a direction, for those that have none, of a map whose rows are gone through twice.
//
// In each column, texels without a direction stand in runs. The first pass notes which texel ends each run, the second
// pass knows which one came before it: so it knows the nearest of every column, the upper of two, and finds the nearest
// of those by a search to either side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/spill_file.h"
#include "burnish/core/vec3.h"

namespace burnish {

// A row of directions and of normals, which may be null; defined[x] is 0 where there is no direction.
struct DirectionRow {
  const std::uint8_t* defined;
  const Vec3f *t, *n;

  Vec3f normal(int x) const { return n ? n[x] : Vec3f{0, 0, 1}; }
};

class NearestDirections {
 public:
  struct Texel {
    Vec3f t, n;
  };

  // `directory`: for a temporary file, where there are more than a million runs.
  NearestDirections(int width, const std::string& directory);

  // First pass: all rows, from the top.
  void note(const DirectionRow& row);
  void end_notes();
  std::size_t missing() const { return missing_; }  // texels without a direction

  // Second pass: rows in ascending order, from any on above which nothing is missing. `above`: row y − 1, where there
  // is one. kept until the next call: `row`.
  void enter(int y, const DirectionRow& row, const DirectionRow* above);
  // By the Euclidean distance of centres; of equally near ones the topmost, then the leftmost. There must be one.
  Texel nearest(int x) const;

 private:
  static constexpr std::int32_t kNoRow = -1;
  struct Source {
    std::int32_t row = kNoRow;
    Texel texel{};
  };
  struct Column {
    std::int64_t run = -1;  // first pass: that has not ended
    bool inside = false;    // second pass: of a run
    Source above, below;    // of the last run
  };

  void store(std::int64_t run, const Source& end);
  Source load(std::int64_t run) const;

  std::vector<Column> columns_;
  std::string directory_;
  std::vector<Source> ends_;  // of the first runs, in the order in which they begin
  std::optional<SpillFile> more_ends_;
  std::int64_t runs_ = 0, next_run_ = 0;
  std::int32_t row_ = 0;
  std::size_t missing_ = 0;
  DirectionRow texels_{};
  std::vector<std::int32_t> nearest_rows_;  // of each column, in the row that was entered
};

}  // namespace burnish
