// File names of frames and of their auxiliary images.
//
// Several frames take a pattern with one %d or %0Nd, which becomes the frame's number, counted from 0; any
// other '%' is itself. An auxiliary image of 'dir/out.png' is 'dir/out.NAME.exr'.
#pragma once

#include <string>
#include <vector>

#include "burnish/render/aov.h"

namespace burnish {

inline constexpr int kMostFrameFiles = 4000;  // written by one run, since all appear together

class FrameNames {
 public:
  // kUsage where several frames have no pattern or a pattern has more than one number, where standard output
  // ("-") is to take more than one file, and where there are more files than kMostFrameFiles.
  FrameNames(const std::string& pattern, int frames, const std::vector<Aov>& aovs);

  // The picture's name, then one an auxiliary image.
  std::vector<std::string> of_frame(int index) const;

 private:
  std::string before_, after_;
  int digits_ = -1;  // −1: no number in the name
  std::vector<Aov> aovs_;
};

}  // namespace burnish
