// Means of an image's samples, level by level: of each channel the weighted means of core/mip.h.
//
// In parallel; results do not depend on threads, nor on how rows are handed over.
#pragma once

#include <functional>
#include <vector>

#include "burnish/core/image.h"

namespace burnish {

// The next coarser level of a whole image.
Image next_mean_level(const Image& finer);

// All levels from the rows of the base as they come. A level keeps the rows that the next one still needs, two at most.
class MeanCascade {
 public:
  // Takes rows [first, first + count) of a level, the base included: of each level from the top, and rows before those
  // of the next level that they complete.
  using Take = std::function<void(int level, int first, int count, const float* rows)>;

  // `levels` with the base, as many as there are at most.
  MeanCascade(int width, int height, int channels, int levels, Take take);
  // The next rows of the base, interleaved.
  void add(int count, const float* rows);

 private:
  struct Level {
    int width, height;
    int rows = 0;             // that have come
    std::vector<float> kept;  // the last of them
  };

  void add(std::size_t level, int count, const float* rows);

  std::vector<Level> levels_;
  int channels_;
  Take take_;
};

}  // namespace burnish
