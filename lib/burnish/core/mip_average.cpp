#include "burnish/core/mip_average.h"

#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"

namespace burnish {

Image next_mean_level(const Image& finer) {
  Image level(next_level_size(finer.width), next_level_size(finer.height), finer.channels);
  parallel_for(std::size_t(level.height), [&](std::size_t y) {
    const MipTaps v = mip_taps(finer.height, int(y));
    for (int x = 0; x < level.width; x++) {
      const MipTaps u = mip_taps(finer.width, x);
      float* to = level.at(x, int(y));
      for (int j = 0; j < v.count; j++)
        for (int i = 0; i < u.count; i++) {
          const float* from = finer.at(u.first + i, v.first + j);
          for (int c = 0; c < level.channels; c++) to[c] += from[c] * float(u.weight[i] * v.weight[j]);
        }
      for (int c = 0; c < level.channels; c++) to[c] /= float(u.total * v.total);
    }
  });
  return level;
}

}  // namespace burnish
