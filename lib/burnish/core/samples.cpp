#include "burnish/core/samples.h"

#include <half.h>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

// to[i] = of(values[i])
template <typename T, typename Of>
void each(const float* values, std::size_t count, void* to, const Of& of) {
  constexpr std::size_t kGrain = std::size_t(1) << 16;
  parallel_for_chunks(count, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) static_cast<T*>(to)[i] = T(of(values[i]));
  });
}

std::uint16_t half_bits_of(float value) { return half(value).bits(); }

}  // namespace

std::size_t sample_bytes(SampleType type) {
  return type == SampleType::kUint8 ? 1 : type == SampleType::kFloat ? 4 : 2;
}

void to_samples(SampleType type, const float* values, std::size_t count, void* samples) {
  switch (type) {
    case SampleType::kUint8:
      return each<std::uint8_t>(values, count, samples, [](float v) { return integer_sample(v, 255.f); });
    case SampleType::kUint16:
      return each<std::uint16_t>(values, count, samples, [](float v) { return integer_sample(v, 65535.f); });
    case SampleType::kHalf:
      return each<std::uint16_t>(values, count, samples, half_bits_of);
    case SampleType::kFloat:
      return each<float>(values, count, samples, [](float v) { return v; });
  }
}

std::vector<std::uint16_t> half_bits(const std::vector<float>& values) {
  std::vector<std::uint16_t> bits(values.size());
  to_samples(SampleType::kHalf, values.data(), values.size(), bits.data());
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
    case SampleType::kHalf:
      for (float& v : values) v = half(v);
      return;
    case SampleType::kFloat:
      return;
  }
}

}  // namespace burnish
