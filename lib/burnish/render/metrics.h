// How far two pictures are apart, on linear RGB.
//
// Over the channel values of the pixels that count, with d the difference of a pair of values:
//   rmse = √(mean d²), psnr_db = 20·log₁₀(peak / rmse) with peak = 1 (display white), infinite where rmse =
//   0, max_abs = max |d|, p95_abs = the smallest value that at least 95 % of |d| do not exceed (nearest
//   rank).
#pragma once

#include <cstddef>

#include "burnish/core/image.h"

namespace burnish {

inline constexpr double kPeak = 1.0;

struct ErrorMetrics {
  double psnr_db = 0, rmse = 0, max_abs = 0, p95_abs = 0;
  std::size_t pixels = 0;  // that counted
};

// The images have one size and channel count; `counts` has the same size, and pixels where it is 0 take no
// part. Runs in parallel, summed in a fixed order. With no pixels at all: infinite PSNR and zeros.
ErrorMetrics compare(const Image& a, const Image& b, const ByteImage& counts);

}  // namespace burnish
