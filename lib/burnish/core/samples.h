// What a file's samples keep of a number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "burnish/core/file_type.h"

namespace burnish {

// The integer from 0 to `most` that stands for a value of [0,1]: rounded half up; beyond the ends, the ends.
inline int integer_sample(float value, float most) { return int(std::min(std::max(value, 0.f), 1.f) * most + 0.5f); }

// Bytes of one.
std::size_t sample_bytes(SampleType type);

// `count` samples of that type: integers as integer_sample() has them, the nearest halves, floats as they are.
void to_samples(SampleType type, const float* values, std::size_t count, void* samples);

// The bits of the nearest halves.
std::vector<std::uint16_t> half_bits(const std::vector<float>& values);

// Rounds to what a file of that type, written and read back here, gives.
void round_to_samples(SampleType type, std::vector<float>& values);

}  // namespace burnish
