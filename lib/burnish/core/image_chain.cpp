#include "burnish/core/image_chain.h"

#include "burnish/core/attribute_text.h"
#include "burnish/core/codecs/exr_file.h"
#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/samples.h"

namespace burnish {

void require_chain(const FileRef& file, int width, int height, int levels) {
  if (const int all = level_count(width, height); levels != 1 && levels != all)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "EXR holds one level or all " + std::to_string(all) + ", not " + std::to_string(levels));
}

struct ImageChainWriter::Impl {
  SampleType sample;
  int width, height, channels;
  detail::ExrWriter out;
  std::vector<std::byte> converted;
};

ImageChainWriter::ImageChainWriter(const FileRef& file, SampleType sample, int width, int height, int channels,
                                   int levels, const Attributes& attributes,
                                   const std::vector<std::string>& channel_names) {
  require_can_hold(FileType::kExr, sample, file.name);
  require_chain(file, width, height, levels);
  const detail::ImageShape shape{width, height, channel_names.empty() ? detail::usual_names(channels) : channel_names,
                                 sample, detail::stored_attributes(FileType::kExr, attributes)};
  impl_.reset(new Impl{sample, width, height, channels, detail::ExrWriter(file, detail::exr_form(shape, levels)), {}});
}

ImageChainWriter::~ImageChainWriter() = default;
ImageChainWriter::ImageChainWriter(ImageChainWriter&&) noexcept = default;

void ImageChainWriter::write_rows(int level, int count, const float* rows) {
  const std::size_t samples = std::size_t(count) * level_size(impl_->width, level) * impl_->channels;
  impl_->converted.resize(samples * sample_bytes(impl_->sample));
  to_samples(impl_->sample, rows, samples, impl_->converted.data());
  impl_->out.write_rows(level, count, impl_->converted.data());
}

void ImageChainWriter::close() { impl_->out.close(); }

void write_image_chain(const FileRef& file, SampleType sample, const std::vector<Image>& levels,
                       const Attributes& attributes) {
  const Image& base = levels[0];
  ImageChainWriter writer(file, sample, base.width, base.height, base.channels, int(levels.size()), attributes);
  for (std::size_t l = 0; l < levels.size(); l++) writer.write_rows(int(l), levels[l].height, levels[l].data.data());
  writer.close();
}

std::vector<Image> read_image_chain(ImageReader& file) {
  std::vector<Image> levels;
  for (int l = 0; l < file.levels(); l++) {
    levels.push_back(file.read_level(l));
    if (l == 0) continue;
    const Image &finer = levels[l - 1], &level = levels[l];
    const int width = next_level_size(finer.width), height = next_level_size(finer.height);
    if (level.width != width || level.height != height)
      throw file_error(ErrorKind::kMalformed, file.name(),
                       "expected " + std::to_string(width) + "x" + std::to_string(height) + " texels in level " +
                           std::to_string(l) + ", got " + std::to_string(level.width) + "x" +
                           std::to_string(level.height));
  }
  return levels;
}

}  // namespace burnish
