#include "burnish/core/samples.h"

#include <cstdint>

#include "burnish/core/codecs.h"

namespace burnish {

void round_to_samples(SampleType type, std::vector<float>& values) {
  switch (type) {
    case SampleType::kUint8:
    case SampleType::kUint16: {
      const float most = type == SampleType::kUint8 ? 255.f : 65535.f;
      for (float& v : values) v = float(integer_sample(v, most)) / most;
      return;
    }
    case SampleType::kHalf: {
      const OIIO::TypeDesc half_type = detail::to_oiio(type);
      std::vector<std::uint16_t> halves(values.size());
      OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), half_type, halves.data(), int(values.size()));
      OIIO::convert_pixel_values(half_type, halves.data(), OIIO::TypeFloat, values.data(), int(values.size()));
      return;
    }
    case SampleType::kFloat:
      return;
  }
}

}  // namespace burnish
