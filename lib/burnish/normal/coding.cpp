#include "burnish/normal/coding.h"

#include <atomic>
#include <cmath>
#include <cstring>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/whole_image.h"
#include "burnish/normal/row_kernels.h"

namespace burnish {
namespace {

constexpr float kShortest = 1e-3f;  // below it a vector has no direction to speak of

int channel_of_letter(char c) {
  switch (std::tolower(static_cast<unsigned char>(c))) {
    case 'x':
    case 'r':
      return 0;
    case 'y':
    case 'g':
      return 1;
    case 'z':
    case 'b':
      return 2;
    case 'w':
    case 'a':
      return 3;
    default:
      return -1;
  }
}

// Of a two-channel file the second letter is what comes second: grey and alpha, or R and G.
int locate(char letter, const ImageReader& reader, const std::string& channels) {
  int c = channel_of_letter(letter);
  if (c < 0)
    throw Error(ErrorKind::kUsage, "--channels: expected letters of x y z w or r g b a, got '" + channels + "'");
  if (reader.channels() == 2 && c == 3) c = 1;
  if (c >= reader.channels())
    throw file_error(ErrorKind::kMalformed, reader.name(),
                     std::string("expected a channel '") + letter + "', got " + std::to_string(reader.channels()) +
                         (reader.channels() == 1 ? " channel" : " channels"));
  return c;
}

}  // namespace

bool is_biased(NormalEncoding encoding, bool integer_samples) {
  return encoding == NormalEncoding::kBiased || (encoding == NormalEncoding::kByType && integer_samples);
}

NormalReader::NormalReader(const FileRef& file, const NormalCoding& coding)
    : reader_(file),
      vectors_{is_biased(coding.encoding, reader_.integer()), coding.green == GreenAxis::kDown,
               coding.channels.size() == 2},
      component_{0, 1, 2} {
  if (coding.channels.empty()) {
    if (reader_.channels() < 3)
      throw file_error(ErrorKind::kMalformed, reader_.name(),
                       "expected 3 channels of a normal map, got " + std::to_string(reader_.channels()) +
                           (reader_.channels() == 2 ? " (of two, --channels xy rebuilds z)" : ""));
    return;
  }
  if (coding.channels.size() != 2 && coding.channels.size() != 3)
    throw Error(ErrorKind::kUsage, "--channels: expected two or three letters, got '" + coding.channels + "'");
  for (std::size_t i = 0; i < 3; i++)
    component_[i] = i < coding.channels.size() ? locate(coding.channels[i], reader_, coding.channels) : -1;
}

Vec3f VectorCoding::decode(float x, float y, float z, bool& invalid) const {
  if (biased) x = 2.f * x - 1.f, y = 2.f * y - 1.f, z = 2.f * z - 1.f;
  if (rebuilds_z) z = std::sqrt(std::max(0.f, 1.f - x * x - y * y));
  const Vec3d v{x, green_down ? -y : y, z};
  const double l = length(v);
  invalid = l < kShortest;
  return invalid ? Vec3f{0, 0, 1} : Vec3f(v / l);
}

void NormalReader::read_rows(int first, int count, Vec3f* out) {
  const std::size_t w = width(), channels = reader_.channels();
  band_.resize(w * channels * count);
  reader_.read_rows(first, count, band_.data());
  std::atomic<std::size_t> invalid = 0;
  std::atomic<std::size_t> broken = SIZE_MAX;
  parallel_for(count, [&](std::size_t row) {
    std::size_t bad = 0;
    for (std::size_t i = row * w; i < (row + 1) * w; i++) {
      const float* t = band_.data() + i * channels;
      const float x = t[component_[0]], y = t[component_[1]], z = component_[2] < 0 ? 0.f : t[component_[2]];
      if (!std::isfinite(x + y + z)) {
        std::size_t least = broken;
        while (i < least && !broken.compare_exchange_weak(least, i)) {
        }
        continue;
      }
      bool short_vector;
      out[i] = vectors_.decode(x, y, z, short_vector);
      bad += short_vector;
    }
    invalid += bad;
  });
  if (broken != SIZE_MAX)
    throw file_error(ErrorKind::kMalformed, name(),
                     "expected finite vectors, got NaN or infinity at column " + std::to_string(broken % w) + ", row " +
                         std::to_string(first + broken / w));
  invalid_ += invalid;
}

std::vector<Vec3f> NormalReader::read_all() {
  return read_whole<Vec3f>(name(), height(), std::size_t(width()),
                           [&](int first, int count, Vec3f* out) { read_rows(first, count, out); });
}

std::vector<Vec3f> read_normals(const FileRef& file, const NormalCoding& coding, int* width, int* height) {
  NormalReader reader(file, coding);
  *width = reader.width();
  *height = reader.height();
  return reader.read_all();
}

void require_encodable(const NormalCoding& coding, SampleType sample, const std::string& name) {
  if (coding.encoding == NormalEncoding::kSigned && is_integer(sample))
    throw file_error(ErrorKind::kUnsupported, name,
                     std::string("the signed encoding needs half or float samples, not ") + burnish::name(sample));
}

void encode_normals(const Vec3f* in, int count, const NormalCoding& coding, SampleType sample, void* out) {
  const float y_sign = coding.green == GreenAxis::kDown ? -1.f : 1.f;
  if (sample == SampleType::kUint8) return kernels::encode_biased(in, count, y_sign, static_cast<std::uint8_t*>(out));
  if (sample == SampleType::kUint16) return kernels::encode_biased(in, count, y_sign, static_cast<std::uint16_t*>(out));
  float* to = static_cast<float*>(out);
  if (is_biased(coding.encoding, false)) return kernels::encode_biased(in, count, y_sign, to);
  std::memcpy(to, in, sizeof(Vec3f) * count);
  if (coding.green == GreenAxis::kDown)
    for (int i = 0; i < count; i++) to[3 * i + 1] = -to[3 * i + 1];
}

}  // namespace burnish
