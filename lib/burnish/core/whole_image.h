// What a header promises and a file may not hold: all rows of an image.
#pragma once

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/physical_memory.h"

namespace burnish {

// `per_row` values of each of `rows` rows, which read(first, count, T* out) gives in ascending bands. Memory is filled
// as rows arrive, and set aside for 16 times what has, so that a file cut short is refused as that, however much it
// promises. kUnsupported, naming the file, where memory does not suffice or the machine has not that much.
template <typename T, typename Read>
std::vector<T> read_whole(const std::string& name, int rows, std::size_t per_row, const Read& read) {
  constexpr std::size_t kBand = std::size_t(1) << 22;  // values
  constexpr std::size_t kAhead = 16;                   // moving what there is costs that part of it
  const auto too_large = [&] {
    return file_error(
        ErrorKind::kUnsupported, name,
        "is larger than memory: " + std::to_string(rows) + " rows of " + std::to_string(per_row) + " values");
  };
  if (per_row > physical_memory() / sizeof(T) / std::size_t(rows)) throw too_large();
  const int band = int(std::clamp<std::size_t>(kBand / per_row, 1, std::size_t(rows)));
  std::vector<T> values;
  try {
    for (int first = 0; first < rows; first += band) {
      const int count = std::min(band, rows - first);
      const std::size_t size = values.size() + per_row * std::size_t(count);
      try {
        if (size > values.capacity()) values.reserve(std::min(kAhead * size, per_row * std::size_t(rows)));
      } catch (const std::exception&) {  // it may not be that much
      }
      values.resize(size);
      read(first, count, values.data() + per_row * std::size_t(first));
    }
  } catch (const std::bad_alloc&) {
    throw too_large();
  }
  return values;
}

}  // namespace burnish
