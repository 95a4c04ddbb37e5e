#include "burnish/core/image_chain.h"

#include "burnish/core/checked_output.h"
#include "burnish/core/error.h"
#include "burnish/core/mip.h"

namespace burnish {

void require_chain(const FileRef& file, int width, int height, int levels) {
  if (const int all = level_count(width, height); levels != 1 && levels != all)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "EXR holds one level or all " + std::to_string(all) + ", not " + std::to_string(levels));
}

struct ImageChainWriter::Impl {
  detail::CheckedOutput out;
  SampleType sample;
  Attributes attributes;
  std::vector<std::string> channel_names;
  bool first = true;
};

ImageChainWriter::ImageChainWriter(const FileRef& file, SampleType sample, const Attributes& attributes,
                                   const std::vector<std::string>& channel_names) {
  require_can_hold(FileType::kExr, sample, file.name);
  impl_.reset(new Impl{detail::CheckedOutput(file, FileType::kExr), sample, attributes, channel_names});
}

ImageChainWriter::~ImageChainWriter() = default;

void ImageChainWriter::write(const Image& level) {
  OIIO::ImageSpec spec = impl_->out.spec(impl_->sample, level.width, level.height, level.channels, impl_->attributes);
  if (!impl_->channel_names.empty()) spec.channelnames = impl_->channel_names;
  spec.tile_width = spec.tile_height = 64;
  spec.attribute("textureformat", "Plain Texture");  // mip levels, rounded down
  impl_->out.open(spec, impl_->first ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendMIPLevel);
  impl_->out.require(impl_->out.image().write_image(OIIO::TypeDesc::FLOAT, level.data.data()));
  impl_->first = false;
}

void ImageChainWriter::close() { impl_->out.close(); }

void write_image_chain(const FileRef& file, SampleType sample, const std::vector<Image>& levels,
                       const Attributes& attributes) {
  if (levels.size() == 1) return write_image(file, FileType::kExr, sample, levels[0], attributes);
  require_chain(file, levels[0].width, levels[0].height, int(levels.size()));
  ImageChainWriter writer(file, sample, attributes);
  for (const Image& level : levels) writer.write(level);
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
