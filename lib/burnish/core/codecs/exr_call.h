// How OpenEXR is called by those that read and those that write.
#pragma once

#include <ImfPixelType.h>
#include <ImfThreading.h>

#include "burnish/core/codecs/exr_file.h"
#include "burnish/core/parallel.h"

namespace burnish::detail {

inline Imf::PixelType to_imf(ExrType type) {
  return type == ExrType::kUint ? Imf::UINT : type == ExrType::kHalf ? Imf::HALF : Imf::FLOAT;
}

// As many threads as the program may use, or none but the caller's.
inline void use_exr_threads() { Imf::setGlobalThreadCount(thread_limit() > 1 ? thread_limit() : 0); }

}  // namespace burnish::detail
