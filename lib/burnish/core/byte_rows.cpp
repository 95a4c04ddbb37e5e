#include "burnish/core/byte_rows.h"

#include <algorithm>

#include "burnish/core/error.h"

namespace burnish {

ByteRows ByteRows::of_ids(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  if (reader.channels() != 1)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected 1 channel of material ids, got " + std::to_string(reader.channels()));
  if (!reader.has_exact_samples() || reader.sample_type() != SampleType::kUint8)
    throw file_error(ErrorKind::kMalformed, file.name,
                     std::string("expected material ids as uint8, got ") + burnish::name(reader.sample_type()));
  reader.require_size(width, height, "the normal map");
  return {std::move(reader), Kind::kIds};
}

ByteRows ByteRows::of_mask(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  reader.require_size(width, height, "the map it masks");
  return {std::move(reader), Kind::kMask};
}

ByteRows::ByteRows(ImageReader file, Kind kind) : file_(std::move(file)), kind_(kind) {
  constexpr std::size_t kMostKept = std::size_t(64) << 20;
  keep_ = std::size_t(file_.width()) * file_.height() <= kMostKept;
}

void ByteRows::read(int first, int count, std::uint8_t* out) {
  if (!keep_) return decode(first, count, out);
  const std::size_t width = file_.width();
  if (const int have = int(kept_.size() / width); have < first + count) {
    kept_.resize(width * (first + count));
    decode(have, first + count - have, kept_.data() + width * have);
  }
  std::copy_n(kept_.data() + width * first, width * count, out);
}

void ByteRows::decode(int first, int count, std::uint8_t* out) {
  if (kind_ == Kind::kIds) return file_.read_rows_stored(first, count, out);
  constexpr int kRows = 64;
  const std::size_t channels = file_.channels(), width = file_.width();
  std::vector<float> samples(width * channels * std::min(count, kRows));
  for (int y = 0; y < count; y += kRows) {
    const int rows = std::min(kRows, count - y);
    file_.read_rows(first + y, rows, samples.data());
    for (std::size_t i = 0; i < width * rows; i++) *out++ = samples[i * channels] != 0.f;
  }
}

}  // namespace burnish
