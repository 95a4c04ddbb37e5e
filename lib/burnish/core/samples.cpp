#include "burnish/core/samples.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace burnish {

void round_to_samples(SampleType type, std::vector<float>& values) {
  switch (type) {
    case SampleType::kUint8:
    case SampleType::kUint16: {
      const float most = type == SampleType::kUint8 ? 255.f : 65535.f;
      for (float& v : values) v = std::floor(std::clamp(v, 0.f, 1.f) * most + 0.5f) / most;
      return;
    }
    case SampleType::kHalf: {
      std::vector<std::uint16_t> halves(values.size());
      OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), OIIO::TypeHalf, halves.data(), int(values.size()));
      OIIO::convert_pixel_values(OIIO::TypeHalf, halves.data(), OIIO::TypeFloat, values.data(), int(values.size()));
      return;
    }
    case SampleType::kFloat:
      return;
  }
}

}  // namespace burnish
