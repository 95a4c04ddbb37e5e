#include "burnish/render/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"

namespace burnish {

ErrorMetrics compare(const Image& a, const Image& b, const ByteImage& counts) {
  constexpr std::size_t kGrain = 1 << 14;
  std::vector<double> differences;
  ErrorMetrics m;
  for (std::size_t i = 0; i < counts.data.size(); i++) {
    if (!counts.data[i]) continue;
    m.pixels++;
    for (std::size_t c = i * a.channels; c < (i + 1) * a.channels; c++)
      differences.push_back(std::abs(double(a.data[c]) - double(b.data[c])));
  }
  m.psnr_db = std::numeric_limits<double>::infinity();
  if (differences.empty()) return m;
  const double sum = parallel_sum<double>(differences.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    double s = 0;
    for (std::size_t i = begin; i < end; i++) s += differences[i] * differences[i];
    return s;
  });
  m.rmse = std::sqrt(sum / double(differences.size()));
  if (m.rmse > 0) m.psnr_db = 20 * portable::log10(kPeak / m.rmse);
  m.max_abs = *std::ranges::max_element(differences);
  const std::size_t rank = (differences.size() * 95 + 99) / 100 - 1;
  std::ranges::nth_element(differences, differences.begin() + std::ptrdiff_t(rank));
  m.p95_abs = differences[rank];
  return m;
}

}  // namespace burnish
