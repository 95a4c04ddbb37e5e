// Means of an image's samples, level by level.
#pragma once

#include "burnish/core/image.h"

namespace burnish {

// The next coarser level: of each channel the weighted means of core/mip.h. In parallel; the result does not depend on
// threads.
Image next_mean_level(const Image& finer);

}  // namespace burnish
