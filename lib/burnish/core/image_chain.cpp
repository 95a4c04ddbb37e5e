#include "burnish/core/image_chain.h"

#include <algorithm>
#include <optional>

#include "burnish/core/checked_output.h"
#include "burnish/core/codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/waiting_levels.h"

namespace burnish {

using detail::to_oiio;

void require_chain(const FileRef& file, int width, int height, int levels) {
  if (const int all = level_count(width, height); levels != 1 && levels != all)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "EXR holds one level or all " + std::to_string(all) + ", not " + std::to_string(levels));
}

namespace {

constexpr int kTile = 64;

// All levels, in tiles.
class TiledChain {
 public:
  TiledChain(const FileRef& file, SampleType sample, int width, int height, int channels, int levels,
             const Attributes& attributes, const std::vector<std::string>& channel_names)
      : out_(file, FileType::kExr),
        spec_(out_.spec(sample, width, height, channels, attributes)),
        waiting_(file, width, height, levels, std::size_t(channels) * spec_.format.size()),
        levels_(levels) {
    if (!channel_names.empty()) spec_.channelnames = channel_names;
    spec_.tile_width = spec_.tile_height = kTile;
    spec_.attribute("textureformat", "Plain Texture");  // mip levels, rounded down
    out_.open(spec_);
  }

  void write_rows(int level, int count, const float* rows) {
    if (level == 0) write_base(count, rows);
    else append(level, count, rows);
  }
  void close() {
    tiles_ = {};
    write_waiting();
    out_.close();
  }

 private:
  // Rows wait as the file's samples, which take less room than floats.
  void write_base(int count, const float* rows) {
    const std::size_t row_samples = std::size_t(spec_.width) * spec_.nchannels;
    const std::size_t row_bytes = row_samples * spec_.format.size();
    while (count > 0) {
      const int wanted = std::min(kTile, spec_.height - tiles_first_);
      const int some = std::min(count, wanted - tiles_rows_);
      tiles_.resize(row_bytes * wanted);
      OIIO::convert_pixel_values(OIIO::TypeFloat, rows, spec_.format, &tiles_[row_bytes * tiles_rows_],
                                 int(row_samples * some));
      tiles_rows_ += some;
      rows += row_samples * some, count -= some;
      if (tiles_rows_ < wanted) return;
      write_tiles(spec_, tiles_first_, tiles_first_ + wanted, tiles_.data());
      tiles_first_ += wanted, tiles_rows_ = 0;
    }
  }
  void append(int level, int count, const float* rows) {
    const std::size_t row_samples = std::size_t(level_size(spec_.width, level)) * spec_.nchannels;
    std::vector<std::byte> row(row_samples * spec_.format.size());
    for (; count > 0; count--, rows += row_samples) {
      OIIO::convert_pixel_values(OIIO::TypeFloat, rows, spec_.format, row.data(), int(row_samples));
      waiting_.append(level, 1, row.data());
    }
  }
  void write_waiting() {
    for (int l = 1; l < levels_; l++) {
      OIIO::ImageSpec coarser = spec_;
      coarser.width = coarser.full_width = level_size(spec_.width, l);
      coarser.height = coarser.full_height = level_size(spec_.height, l);
      out_.open(coarser, OIIO::ImageOutput::AppendMIPLevel);
      std::vector<std::byte> rows(std::size_t(coarser.width) * coarser.nchannels * coarser.format.size() * kTile);
      for (int y = 0; y < coarser.height; y += kTile) {
        const int count = std::min(kTile, coarser.height - y);
        waiting_.read(l, y, count, rows.data());
        write_tiles(coarser, y, y + count, rows.data());
      }
    }
  }
  void write_tiles(const OIIO::ImageSpec& of, int first, int end, const std::byte* rows) {
    out_.require(out_.image().write_tiles(0, of.width, first, end, 0, 1, of.format, rows));
  }

  detail::CheckedOutput out_;
  OIIO::ImageSpec spec_;
  WaitingLevels waiting_;
  int levels_;
  std::vector<std::byte> tiles_;  // of the base, a row of tiles that is not complete
  int tiles_first_ = 0, tiles_rows_ = 0;
};

}  // namespace

// One of the two.
struct ImageChainWriter::Impl {
  std::optional<ImageWriter> plain;
  std::optional<TiledChain> tiled;
};

ImageChainWriter::ImageChainWriter(const FileRef& file, SampleType sample, int width, int height, int channels,
                                   int levels, const Attributes& attributes,
                                   const std::vector<std::string>& channel_names)
    : impl_(std::make_unique<Impl>()) {
  require_can_hold(FileType::kExr, sample, file.name);
  require_chain(file, width, height, levels);
  if (levels == 1)
    impl_->plain.emplace(file, FileType::kExr, sample, width, height, channels, attributes, channel_names);
  else impl_->tiled.emplace(file, sample, width, height, channels, levels, attributes, channel_names);
}

ImageChainWriter::~ImageChainWriter() = default;
ImageChainWriter::ImageChainWriter(ImageChainWriter&&) noexcept = default;

void ImageChainWriter::write_rows(int level, int count, const float* rows) {
  if (impl_->plain) impl_->plain->write_rows(count, rows);
  else impl_->tiled->write_rows(level, count, rows);
}

void ImageChainWriter::close() {
  if (impl_->plain) impl_->plain->close();
  else impl_->tiled->close();
}

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
