// Where the heights of a displacement map stand: in which channel, and at which texel beyond the map's edges.
#pragma once

#include <string>

#include "burnish/core/image_io.h"
#include "burnish/normal/height_map.h"

namespace burnish {

// The channel of a file that holds its heights.
class HeightChannel {
 public:
  // By name, whatever the case, or by number from 0; the first where `wanted` is empty. kMalformed where the file has
  // none such.
  HeightChannel(const ImageReader& reader, const std::string& wanted);

  // Takes the heights out of texels of all channels.
  void take(const float* samples, std::size_t texels, float* heights);
  // So far, and none was chosen.
  bool colours_differ() const { return colours_differ_; }

 private:
  std::size_t channels_, channel_ = 0;
  bool is_chosen_, colours_differ_ = false;
};

// Which row or column stands at i, for i outside [0, n) too; −1: none.
int wrapped_texel(int i, int n, Wrap wrap);

}  // namespace burnish
