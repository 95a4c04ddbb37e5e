// Images in memory: interleaved float samples, and planes of indices. Row 0 is the top row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace burnish {

template <typename T>
struct BasicImage {
  int width = 0, height = 0, channels = 1;
  std::vector<T> data;  // height · width · channels, interleaved

  BasicImage() = default;
  BasicImage(int w, int h, int c = 1) : width(w), height(h), channels(c), data(std::size_t(w) * h * c) {}

  std::size_t texels() const { return std::size_t(width) * height; }
  T* row(int y) { return data.data() + std::size_t(y) * width * channels; }
  const T* row(int y) const { return data.data() + std::size_t(y) * width * channels; }
  T* at(int x, int y) { return row(y) + std::size_t(x) * channels; }
  const T* at(int x, int y) const { return row(y) + std::size_t(x) * channels; }
};

using Image = BasicImage<float>;
using ByteImage = BasicImage<std::uint8_t>;
using IndexImage = BasicImage<std::uint16_t>;

}  // namespace burnish
