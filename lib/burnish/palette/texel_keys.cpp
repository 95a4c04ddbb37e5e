#include "burnish/palette/texel_keys.h"

#include <Imath/half.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/octahedral.h"

namespace burnish {
namespace {

constexpr std::size_t kKeepBytes = std::size_t(128) << 20;
constexpr int kOctahedralBits = 24, kVectorBits = 48;
// The octahedral square leaves one number over: it marks vectors without a direction.
constexpr std::uint64_t kInvalid = (std::uint64_t(1) << kVectorBits) - 1;
// Above the vector: two bits of the packing, three of the coding.
constexpr int kCodingShift = kVectorBits + 2;
constexpr std::uint64_t kBiased = 1, kGreenDown = 2, kRebuildsZ = 4;

float half_value(std::uint16_t bits) {
  half h;
  h.setBits(bits);
  return h;
}

}  // namespace

TexelKeys::TexelKeys(const FileRef& file, const NormalCoding& coding) : reader_(file, coding) {
  const ImageReader& image = reader_.image();
  const bool exact = image.has_exact_samples();
  packing_ = !exact                                       ? Packing::kOctahedral
             : image.sample_type() == SampleType::kUint8  ? Packing::kBytes
             : image.sample_type() == SampleType::kUint16 ? Packing::kWords
             : image.sample_type() == SampleType::kHalf   ? Packing::kHalves
                                                          : Packing::kOctahedral;
  const VectorCoding& c = reader_.vectors();
  const std::uint64_t bits =
      (c.biased ? kBiased : 0) | (c.green_down ? kGreenDown : 0) | (c.rebuilds_z ? kRebuildsZ : 0);
  tag_ = (packing_ == Packing::kOctahedral ? 0 : bits << kCodingShift) | std::uint64_t(packing_) << kVectorBits;
  const std::size_t sample = packing_ == Packing::kBytes ? 1 : packing_ == Packing::kOctahedral ? 4 : 2;
  row_bytes_ = sample * image.channels() * image.width();
  const std::size_t bytes = row_bytes_ * height();
  if (bytes <= kKeepBytes) whole_ = std::make_unique_for_overwrite<std::byte[]>(bytes);
}

void TexelKeys::read_rows(int first, int count, std::uint64_t* keys) {
  const auto load = [&](int from, int rows, std::byte* to) {
    if (packing_ == Packing::kOctahedral) reader_.image().read_rows(from, rows, reinterpret_cast<float*>(to));
    else reader_.image().read_rows_stored(from, rows, to);
  };
  std::vector<std::byte> band;
  const std::byte* samples;
  if (whole_) {
    if (first + count > loaded_rows_) {
      load(loaded_rows_, first + count - loaded_rows_, whole_.get() + row_bytes_ * loaded_rows_);
      loaded_rows_ = first + count;
    }
    samples = whole_.get() + row_bytes_ * first;
  } else {
    band.resize(row_bytes_ * count);
    load(first, count, band.data());
    samples = band.data();
  }
  std::atomic<int> broken_row = height();
  parallel_for(count, [&](std::size_t row) {
    try {
      pack(samples + row * row_bytes_, width(), keys + row * width(), first + int(row));
    } catch (const Error&) {  // of several, the first row is named, whatever the threads
      int least = broken_row;
      while (first + int(row) < least && !broken_row.compare_exchange_weak(least, first + int(row))) {
      }
    }
  });
  if (broken_row < height()) pack(samples + std::size_t(broken_row - first) * row_bytes_, width(), keys, broken_row);
}

void TexelKeys::pack(const std::byte* samples, std::size_t texels, std::uint64_t* keys, int row) const {
  const int* c = reader_.components();
  const std::size_t channels = reader_.image().channels();
  const auto stored = [&]<typename T>(const T* s) {
    for (std::size_t i = 0; i < texels; i++, s += channels)
      keys[i] = tag_ | std::uint64_t(s[c[0]]) << 32 | std::uint64_t(s[c[1]]) << 16 | (c[2] < 0 ? 0u : s[c[2]]);
  };
  const auto refuse = [&](std::size_t column) {
    throw file_error(ErrorKind::kMalformed, name(),
                     "expected finite vectors, got NaN or infinity at column " + std::to_string(column) + ", row " +
                         std::to_string(row));
  };
  switch (packing_) {
    case Packing::kBytes:
      return stored(reinterpret_cast<const std::uint8_t*>(samples));
    case Packing::kWords:
      return stored(reinterpret_cast<const std::uint16_t*>(samples));
    case Packing::kHalves:
      stored(reinterpret_cast<const std::uint16_t*>(samples));
      for (std::size_t i = 0; i < texels; i++)
        for (int shift : {0, 16, 32})  // all ones in the exponent
          if ((keys[i] >> shift & 0x7c00) == 0x7c00) refuse(i);
      return;
    case Packing::kOctahedral: {
      const float* s = reinterpret_cast<const float*>(samples);
      for (std::size_t i = 0; i < texels; i++, s += channels) {
        const float z = c[2] < 0 ? 0.f : s[c[2]];
        if (!std::isfinite(s[c[0]] + s[c[1]] + z)) refuse(i);
        bool invalid;
        const Vec3f n = reader_.vectors().decode(s[c[0]], s[c[1]], z, invalid);
        keys[i] = tag_ | (invalid ? kInvalid : pack_octahedral(Vec3d(n), kOctahedralBits));
      }
    }
  }
}

Vec3f TexelKeys::decode(std::uint64_t key, bool& invalid) {
  const std::uint16_t x = std::uint16_t(key >> 32), y = std::uint16_t(key >> 16), z = std::uint16_t(key);
  const std::uint64_t bits = key >> kCodingShift;
  const VectorCoding coding{(bits & kBiased) != 0, (bits & kGreenDown) != 0, (bits & kRebuildsZ) != 0};
  switch (Packing(key >> kVectorBits & 3)) {
    case Packing::kBytes:
      return coding.decode(x / 255.f, y / 255.f, z / 255.f, invalid);
    case Packing::kWords:
      return coding.decode(x / 65535.f, y / 65535.f, z / 65535.f, invalid);
    case Packing::kHalves:
      return coding.decode(half_value(x), half_value(y), half_value(z), invalid);
    default:
      invalid = (key & kInvalid) == kInvalid;
      return invalid ? Vec3f{0, 0, 1} : Vec3f(unpack_octahedral(key & kInvalid, kOctahedralBits));
  }
}

bool TexelKeys::is_key(std::uint64_t number) {
  const std::uint64_t x = number >> 32 & 0xffff, y = number >> 16 & 0xffff, z = number & 0xffff;
  const std::uint64_t bits = number >> kCodingShift;
  if (number >> kBits != 0 || ((bits & kRebuildsZ) && z != 0)) return false;
  switch (Packing(number >> kVectorBits & 3)) {
    case Packing::kBytes:
      return std::max({x, y, z}) <= 0xff;
    case Packing::kWords:
      return true;
    case Packing::kHalves:
      return std::max({x & 0x7fff, y & 0x7fff, z & 0x7fff}) < 0x7c00;  // none infinite or NaN
    default: {
      constexpr std::uint64_t kMost = (1 << kOctahedralBits) - 2;
      const std::uint64_t u = number >> kOctahedralBits & (kMost + 1), v = number & (kMost + 1);
      return bits == 0 && ((number & kInvalid) == kInvalid || std::max(u, v) <= kMost);
    }
  }
}

}  // namespace burnish
