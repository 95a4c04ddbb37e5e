#include <algorithm>
#include <cstdint>

#include "burnish/core/attribute_text.h"
#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/samples.h"

namespace burnish {

struct ImageWriter::Impl {
  detail::ImageShape shape;
  std::unique_ptr<detail::ImageSink> out;
  std::size_t row_bytes;
  int next = 0;
  std::vector<std::byte> converted;
  std::vector<std::byte> pending;  // rows that have come, fewer than kAtOnce

  // Codecs compress strips of rows that they get whole side by side, and other ones to other bytes: so they get
  // multiples of 64 rows, however these come.
  static constexpr int kAtOnce = 64;

  void write(int count, const void* rows) {
    const std::byte* from = static_cast<const std::byte*>(rows);
    while (count > 0) {
      const int have = int(pending.size() / row_bytes), left = shape.height - next;
      if (left == 0)
        throw Error(ErrorKind::kInternal, "an image of " + std::to_string(shape.height) + " rows was given more");
      int some = std::min(have + count, left);
      if (some < left) some = some / kAtOnce * kAtOnce;  // that can be put now
      if (have == 0 && some > 0) {
        put(some, from);
      } else {
        some = std::min(count, std::min(kAtOnce, left) - have);
        pending.insert(pending.end(), from, from + some * row_bytes);
        if (have + some == std::min(kAtOnce, left)) put(have + some, pending.data()), pending.clear();
      }
      from += some * row_bytes, count -= some;
    }
  }
  void put(int count, const void* rows) {
    out->write_rows(count, rows);
    next += count;
  }
};

ImageWriter::ImageWriter(const FileRef& file, FileType type, SampleType sample, int width, int height, int channels,
                         const Attributes& attributes, const std::vector<std::string>& channel_names) {
  require_can_hold(type, sample, file.name);
  impl_.reset(new Impl{{width, height, channel_names.empty() ? detail::usual_names(channels) : channel_names, sample,
                        detail::stored_attributes(type, attributes)},
                       nullptr,
                       std::size_t(width) * channels * sample_bytes(sample),
                       0,
                       {},
                       {}});
  impl_->out = type == FileType::kPng   ? detail::create_png_image(file, impl_->shape)
               : type == FileType::kExr ? detail::create_exr_image(file, impl_->shape)
                                        : detail::create_other_image(file, type, impl_->shape);
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;

void ImageWriter::write_rows(int count, const float* rows) {
  if (impl_->shape.sample == SampleType::kFloat) return impl_->write(count, rows);
  const std::size_t samples = std::size_t(count) * impl_->shape.width * impl_->shape.channels();
  impl_->converted.resize(samples * sample_bytes(impl_->shape.sample));
  to_samples(impl_->shape.sample, rows, samples, impl_->converted.data());
  impl_->write(count, impl_->converted.data());
}

void ImageWriter::write_rows_stored(int count, const void* rows) { impl_->write(count, rows); }

void ImageWriter::close() { impl_->out->close(); }

}  // namespace burnish
