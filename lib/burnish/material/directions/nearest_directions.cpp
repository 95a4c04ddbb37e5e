#include "burnish/material/directions/nearest_directions.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace burnish {
namespace {

constexpr std::int64_t kInMemory = 1 << 20;  // 28 MiB

}  // namespace

NearestDirections::NearestDirections(int width, const std::string& directory)
    : columns_(width), directory_(directory), nearest_rows_(width) {}

void NearestDirections::note(const DirectionRow& row) {
  for (std::size_t x = 0; x < columns_.size(); x++) {
    std::int64_t& run = columns_[x].run;
    if (!row.defined[x]) {
      missing_++;
      if (run < 0) run = runs_++;
    } else if (run >= 0) {
      store(run, {row_, {row.t[x], row.normal(int(x))}});
      run = -1;
    }
  }
  row_++;
}

void NearestDirections::end_notes() {
  for (Column& c : columns_)
    if (c.run >= 0) store(c.run, {});
}

void NearestDirections::enter(int y, const DirectionRow& row, const DirectionRow* above) {
  row_ = y;
  texels_ = row;
  for (std::size_t x = 0; x < columns_.size(); x++) {
    Column& c = columns_[x];
    nearest_rows_[x] = y;
    if (row.defined[x]) {
      c.inside = false;
      continue;
    }
    if (!c.inside) {
      c.above = above ? Source{y - 1, {above->t[x], above->normal(int(x))}} : Source{};
      c.below = load(next_run_++);
      c.inside = true;
    }
    const bool upper = c.below.row == kNoRow || (c.above.row != kNoRow && y - c.above.row <= c.below.row - y);
    nearest_rows_[x] = upper ? c.above.row : c.below.row;
  }
}

NearestDirections::Texel NearestDirections::nearest(int x) const {
  const int width = int(columns_.size());
  // Squared distance, row, column.
  std::tuple<std::int64_t, std::int32_t, int> best{std::numeric_limits<std::int64_t>::max(), 0, 0};
  for (int dx = 0; dx < width && std::int64_t(dx) * dx <= std::get<0>(best); dx++)
    for (const int at : {x - dx, x + dx}) {
      if (at < 0 || at >= width || nearest_rows_[at] == kNoRow) continue;
      const std::int64_t dy = std::int64_t(row_) - nearest_rows_[at];
      best = std::min(best, {std::int64_t(dx) * dx + dy * dy, nearest_rows_[at], at});
    }
  const auto [distance, row, column] = best;
  if (row == row_) return {texels_.t[column], texels_.normal(column)};
  const Column& c = columns_[column];
  return row == c.above.row ? c.above.texel : c.below.texel;
}

void NearestDirections::store(std::int64_t run, const Source& end) {
  if (run < kInMemory) {
    if (std::size_t(run) >= ends_.size()) ends_.resize(run + 1);
    ends_[run] = end;
    return;
  }
  if (!more_ends_) more_ends_.emplace(directory_);
  more_ends_->write(std::size_t(run - kInMemory) * sizeof end, &end, sizeof end);
}

NearestDirections::Source NearestDirections::load(std::int64_t run) const {
  Source end;
  if (run < kInMemory) return ends_[run];
  more_ends_->read(std::size_t(run - kInMemory) * sizeof end, &end, sizeof end);
  return end;
}

}  // namespace burnish
