#include "burnish/core/mip_average.h"

#include <cstdint>
#include <utility>

#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// A row of the next level, its samples 0 before, from those of the finer one that `v` weighs; row(y) is one of them.
template <typename Row>
void mean_row(const Row& row, const MipTaps& v, int finer_width, int channels, float* to) {
  const float* finer[3];
  for (int j = 0; j < v.count; j++) finer[j] = row(v.first + j);
  for (int x = 0; x < next_level_size(finer_width); x++, to += channels) {
    const MipTaps u = mip_taps(finer_width, x);
    for (int j = 0; j < v.count; j++)
      for (int i = 0; i < u.count; i++) {
        const float* from = finer[j] + std::size_t(u.first + i) * channels;
        for (int c = 0; c < channels; c++) to[c] += from[c] * float(u.weight[i] * v.weight[j]);
      }
    for (int c = 0; c < channels; c++) to[c] /= float(u.total * v.total);
  }
}

}  // namespace

Image next_mean_level(const Image& finer) {
  Image level(next_level_size(finer.width), next_level_size(finer.height), finer.channels);
  parallel_for(std::size_t(level.height), [&](std::size_t y) {
    mean_row([&](int from) { return finer.row(from); }, mip_taps(finer.height, int(y)), finer.width, finer.channels,
             level.row(int(y)));
  });
  return level;
}

MeanCascade::MeanCascade(int width, int height, int channels, int levels, Take take)
    : channels_(channels), take_(std::move(take)) {
  for (; int(levels_.size()) < levels; width = next_level_size(width), height = next_level_size(height))
    levels_.push_back({width, height, 0, {}});
}

void MeanCascade::add(int count, const float* rows) { add(0, count, rows); }

void MeanCascade::add(std::size_t l, int count, const float* rows) {
  Level& level = levels_[l];
  take_(int(l), level.rows, count, rows);
  const int fresh = level.rows, end = fresh + count;
  level.rows = end;
  if (l + 1 == levels_.size()) return;

  const std::size_t row_size = std::size_t(level.width) * channels_;
  const int kept = fresh - int(level.kept.size() / row_size);
  const auto row = [&](int y) {
    return y < fresh ? level.kept.data() + (y - kept) * row_size : rows + (y - fresh) * row_size;
  };
  const Level& next = levels_[l + 1];
  const auto complete = [&](int y) {
    const MipTaps v = mip_taps(level.height, y);
    return v.first + v.count <= end;
  };
  int made = next.rows;
  while (made < next.height && complete(made)) made++;
  const int first = next.rows;
  std::vector<float> means(std::size_t(made - first) * next.width * channels_);
  parallel_for(std::size_t(made - first), [&](std::size_t i) {
    mean_row(row, mip_taps(level.height, first + int(i)), level.width, channels_,
             means.data() + i * next.width * channels_);
  });
  std::vector<float> keep;
  if (made < next.height)
    for (int y = mip_taps(level.height, made).first; y < end; y++) keep.insert(keep.end(), row(y), row(y) + row_size);
  level.kept = std::move(keep);
  if (made > first) add(l + 1, made - first, means.data());
}

}  // namespace burnish
