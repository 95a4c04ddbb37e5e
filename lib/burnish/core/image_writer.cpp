#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "burnish/core/checked_output.h"
#include "burnish/core/codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/samples.h"

namespace burnish {

using detail::to_oiio;

struct ImageWriter::Impl {
  detail::CheckedOutput out;
  OIIO::ImageSpec spec;
  SampleType sample;
  int next = 0;
  std::vector<std::byte> converted;
  std::vector<std::byte> pending;  // rows that have come, fewer than kAtOnce

  // Codecs compress strips of rows that they get whole side by side, and other ones to other bytes: so they get
  // multiples of 64 rows, however these come.
  static constexpr int kAtOnce = 64;

  // Rows of one file are all of one type.
  void write(int count, const void* rows, OIIO::TypeDesc type) {
    const std::size_t row_bytes = std::size_t(spec.width) * spec.nchannels * type.size();
    const std::byte* from = static_cast<const std::byte*>(rows);
    while (count > 0) {
      const int have = int(pending.size() / row_bytes), left = spec.height - next;
      if (left == 0)
        throw Error(ErrorKind::kInternal, "an image of " + std::to_string(spec.height) + " rows was given more");
      int some = std::min(have + count, left);
      if (some < left) some = some / kAtOnce * kAtOnce;  // that can be put now
      if (have == 0 && some > 0) {
        put(some, from, type);
      } else {
        some = std::min(count, std::min(kAtOnce, left) - have);
        pending.insert(pending.end(), from, from + some * row_bytes);
        if (have + some == std::min(kAtOnce, left)) put(have + some, pending.data(), type), pending.clear();
      }
      from += some * row_bytes, count -= some;
    }
  }
  void put(int count, const void* rows, OIIO::TypeDesc type) {
    out.require(out.image().write_scanlines(next, next + count, 0, type, rows));
    next += count;
  }
};

ImageWriter::ImageWriter(const FileRef& file, FileType type, SampleType sample, int width, int height, int channels,
                         const Attributes& attributes, const std::vector<std::string>& channel_names) {
  require_can_hold(type, sample, file.name);
  impl_.reset(new Impl{detail::CheckedOutput(file, type), {}, sample, 0, {}, {}});
  impl_->spec = impl_->out.spec(sample, width, height, channels, attributes);
  if (!channel_names.empty()) impl_->spec.channelnames = channel_names;
  impl_->out.open(impl_->spec);
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;

void ImageWriter::write_rows(int count, const float* rows) {
  const std::size_t samples = std::size_t(count) * impl_->spec.width * impl_->spec.nchannels;
  if (!is_integer(impl_->sample)) {
    impl_->write(count, rows, OIIO::TypeDesc::FLOAT);
    return;
  }
  impl_->converted.resize(samples * to_oiio(impl_->sample).size());
  const auto round = [&](auto* to, float max) {
    for (std::size_t i = 0; i < samples; i++)
      to[i] = static_cast<std::remove_reference_t<decltype(*to)>>(integer_sample(rows[i], max));
  };
  if (impl_->sample == SampleType::kUint8) round(reinterpret_cast<std::uint8_t*>(impl_->converted.data()), 255.f);
  else round(reinterpret_cast<std::uint16_t*>(impl_->converted.data()), 65535.f);
  write_rows_stored(count, impl_->converted.data());
}

void ImageWriter::write_rows_stored(int count, const void* rows) { impl_->write(count, rows, impl_->spec.format); }

void ImageWriter::close() { impl_->out.close(); }

}  // namespace burnish
