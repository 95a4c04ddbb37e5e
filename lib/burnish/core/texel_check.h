// Samples of an image held against what they must be.
#pragma once

#include <span>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {

// kMalformed, naming file, value, column and row, for the first sample of channels [first, last) that does not hold;
// `wanted` says what would. Texels of `channels` samples stand in rows of `width`, the first being `first_row`.
template <typename Holds>
void require_samples(const std::string& name, std::span<const float> samples, int width, int channels, int first,
                     int last, const Holds& holds, const std::string& wanted, int first_row = 0) {
  const std::size_t texels = samples.size() / std::size_t(channels);
  for (std::size_t i = 0; i < texels; i++)
    for (int c = first; c < last; c++)
      if (const float got = samples[i * channels + c]; !holds(got))
        throw file_error(ErrorKind::kMalformed, name,
                         "expected " + wanted + ", got " + number_text(got) + " at column " +
                             std::to_string(i % std::size_t(width)) + ", row " +
                             std::to_string(first_row + i / std::size_t(width)));
}

}  // namespace burnish
