// What a file's samples keep of a number.
#pragma once

#include <vector>

#include "burnish/core/file_type.h"

namespace burnish {

inline bool is_integer(SampleType type) { return type == SampleType::kUint8 || type == SampleType::kUint16; }

// Rounds to what a file of that type, written and read back here, gives: integers hold [0,1], rounded half up.
void round_to_samples(SampleType type, std::vector<float>& values);

}  // namespace burnish
