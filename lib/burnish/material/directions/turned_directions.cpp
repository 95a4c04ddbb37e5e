#include "burnish/material/directions/turned_directions.h"

#include <algorithm>
#include <vector>

#include "burnish/core/band_rows.h"

namespace burnish {

TurnedDirections::TurnedDirections(const FileRef& file, const DirectionCoding& coding, const DirectionTurns& turns,
                                   const std::string& directory)
    : reader_(file, coding), turns_(turns), directory_(directory) {
  turns_.quarters = (turns.quarters % 4 + 4) % 4;
}

bool TurnedDirections::backwards() const {
  return on_its_side() ? (turns_.quarters == 1) != turns_.flip_u : (turns_.quarters == 2) != turns_.flip_v;
}

DirectionMap TurnedDirections::rows(int first, int count) {
  if (!on_its_side() && !backwards()) return turned(reader_.rows(first, count), turns_);
  if (!strips_) spill();
  const int from = backwards() ? height() - first - count : first;
  const Image part =
      on_its_side() ? spilled(from, 0, count, reader_.height()) : spilled(0, from, reader_.width(), count);
  return turned(reader_.decode(part), turns_);
}

void TurnedDirections::spill() {
  const int w = reader_.width(), h = reader_.height();
  strips_.emplace(directory_);
  strip_width_ = on_its_side() ? std::min(w, 64) : w;
  std::vector<float> piece;
  for (int y = 0; y < h; y += band_rows(w)) {
    const Image band = reader_.samples(y, std::min(band_rows(w), h - y));
    channels_ = band.channels;
    for (int x = 0; x < w; x += strip_width_) {
      const std::size_t columns = std::size_t(std::min(strip_width_, w - x)) * channels_;
      piece.clear();
      for (int row = 0; row < band.height; row++) piece.insert(piece.end(), band.at(x, row), band.at(x, row) + columns);
      const std::size_t at = std::size_t(x) * h * channels_ + y * columns;
      strips_->write(at * sizeof(float), piece.data(), piece.size() * sizeof(float));
    }
  }
}

Image TurnedDirections::spilled(int x, int y, int width, int height) const {
  Image part(width, height, channels_);
  std::vector<float> piece;
  for (int strip = x / strip_width_ * strip_width_; strip < x + width; strip += strip_width_) {
    const int strip_end = std::min(strip + strip_width_, reader_.width());
    const std::size_t columns = std::size_t(strip_end - strip) * channels_;
    piece.resize(columns * height);
    const std::size_t at = std::size_t(strip) * reader_.height() * channels_ + y * columns;
    strips_->read(at * sizeof(float), piece.data(), piece.size() * sizeof(float));
    const int first = std::max(strip, x), end = std::min(strip_end, x + width);
    for (int row = 0; row < height; row++)
      std::copy_n(&piece[row * columns + std::size_t(first - strip) * channels_], std::size_t(end - first) * channels_,
                  part.at(first - x, row));
  }
  return part;
}

}  // namespace burnish
