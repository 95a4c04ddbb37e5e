#include "burnish/core/samples.h"

#include "burnish/core/codecs.h"

namespace burnish {

std::vector<std::uint16_t> half_bits(const std::vector<float>& values) {
  std::vector<std::uint16_t> bits(values.size());
  OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), detail::to_oiio(SampleType::kHalf), bits.data(),
                             int(values.size()));
  return bits;
}

void round_to_samples(SampleType type, std::vector<float>& values) {
  switch (type) {
    case SampleType::kUint8:
    case SampleType::kUint16: {
      const float most = type == SampleType::kUint8 ? 255.f : 65535.f;
      for (float& v : values) v = float(integer_sample(v, most)) / most;
      return;
    }
    case SampleType::kHalf: {
      const std::vector<std::uint16_t> bits = half_bits(values);
      OIIO::convert_pixel_values(detail::to_oiio(type), bits.data(), OIIO::TypeFloat, values.data(),
                                 int(values.size()));
      return;
    }
    case SampleType::kFloat:
      return;
  }
}

}  // namespace burnish
