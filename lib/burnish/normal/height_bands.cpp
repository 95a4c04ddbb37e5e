#include "burnish/normal/height_bands.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "burnish/core/band_rows.h"
#include "burnish/core/error.h"
#include "burnish/normal/height_texels.h"

namespace burnish {

HeightBands::HeightBands(const FileRef& file, const HeightMapOptions& options, int radius)
    : options_(options), radius_(radius), reader_(file), channel_(reader_, options.channel) {
  if (!options.mask.empty()) {
    mask_.emplace(options.mask);
    mask_->require_size(width(), height(), "the height map");
  }
  band_rows_ = band_rows(width());
  const bool whole_in_window = height() <= band_rows_ + radius_;
  if (options.wrap_v == Wrap::kRepeat && !whole_in_window) {  // the first band needs the last rows
    ImageReader again(file);
    std::optional<ImageReader> mask_again;
    if (mask_) mask_again.emplace(options.mask);
    for (int y = height() - radius_; y < height(); y++)
      tail_.push_back(std::move(read_rows(again, mask_again ? &*mask_again : nullptr, y, 1)[0]));
  }
}

HeightBand HeightBands::next() {
  HeightBand band;
  band.first = next_;
  band.rows = std::min(band_rows_, height() - next_);
  band.stride = width() + 2 * radius_;
  advance_window(std::max(0, band.first - radius_), std::min(height(), band.first + band.rows + radius_));
  const std::size_t size = std::size_t(band.rows + 2 * radius_) * band.stride;
  band.displacement.resize(size);
  if (mask_) band.exists.resize(size);
  for (int p = 0; p < band.rows + 2 * radius_; p++) {
    const std::size_t at = std::size_t(p) * band.stride;
    fill_row(wrapped_texel(band.first - radius_ + p, height(), options_.wrap_v), band.displacement.data() + at,
             mask_ ? band.exists.data() + at : nullptr);
  }
  next_ += band.rows;
  return band;
}

auto HeightBands::read_rows(ImageReader& reader, ImageReader* mask, int first, int count) -> std::vector<Row> {
  const std::size_t w = width(), c = reader.channels();
  samples_.resize(w * c * count);
  reader.read_rows(first, count, samples_.data());
  std::vector<Row> rows(count);
  for (int y = 0; y < count; y++) {
    const float* in = samples_.data() + std::size_t(y) * w * c;
    Row& row = rows[y];
    row.displacement.resize(w);
    channel_.take(in, w, row.displacement.data());
    if (mask) {
      const std::size_t mc = mask->channels();
      mask_samples_.resize(w * mc);
      mask->read_rows(first + y, 1, mask_samples_.data());
      row.exists.resize(w);
      for (std::size_t x = 0; x < w; x++) row.exists[x] = mask_samples_[x * mc] != 0.f;
    }
    float bad = 0;
    for (std::size_t x = 0; x < w; x++) bad += row.displacement[x] - row.displacement[x];
    if (bad != 0) discard_or_refuse(reader, row, first + y);
  }
  return rows;
}

// Infinities and NaN are no obstacle where the mask says that there is nothing.
void HeightBands::discard_or_refuse(const ImageReader& reader, Row& row, int y) const {
  for (std::size_t x = 0; x < row.displacement.size(); x++) {
    if (std::isfinite(row.displacement[x])) continue;
    if (row.exists.empty() || row.exists[x])
      throw file_error(ErrorKind::kMalformed, reader.name(),
                       "expected finite heights, got NaN or infinity at column " + std::to_string(x) + ", row " +
                           std::to_string(y) + " (--mask can exclude it)");
    row.displacement[x] = 0;
  }
}

void HeightBands::advance_window(int first, int end) {
  while (window_first_ < first && !window_.empty()) window_.erase(window_.begin()), window_first_++;
  const int have = window_first_ + int(window_.size());
  if (end <= have) return;
  std::vector<Row> fresh = read_rows(reader_, mask_ ? &*mask_ : nullptr, have, end - have);
  for (Row& row : fresh) {
    if (options_.wrap_v == Wrap::kRepeat && int(head_.size()) < radius_) head_.push_back(row);
    window_.push_back(std::move(row));
  }
}

auto HeightBands::row_at(int y) const -> const Row& {
  if (y >= window_first_ && y < window_first_ + int(window_.size())) return window_[y - window_first_];
  if (y < int(head_.size())) return head_[y];
  return tail_[y - (height() - int(tail_.size()))];
}

void HeightBands::fill_row(int y, float* displacement, std::uint8_t* exists) const {
  const int w = width();
  if (y < 0) {  // beyond the edge with Wrap::kFit: never used as a height
    std::fill_n(displacement, w + 2 * radius_, 0.f);
    if (exists) std::fill_n(exists, w + 2 * radius_, std::uint8_t(0));
    return;
  }
  const Row& row = row_at(y);
  std::memcpy(displacement + radius_, row.displacement.data(), sizeof(float) * w);
  if (exists) std::memcpy(exists + radius_, row.exists.data(), w);
  for (int i = 0; i < radius_; i++)
    for (const auto& [x, at] : {std::pair{i - radius_, i}, std::pair{w + i, radius_ + w + i}}) {
      const int from = wrapped_texel(x, w, options_.wrap_u);
      displacement[at] = from < 0 ? 0.f : row.displacement[from];
      if (exists) exists[at] = from < 0 ? 0 : row.exists[from];
    }
}

}  // namespace burnish
