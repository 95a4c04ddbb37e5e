#include "burnish/palette/indexed_rows.h"

#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish {

IndexRowSink append_to(IndexImage& image, int width) {
  image.width = width;
  return [&image](int count, const std::uint16_t* rows) {
    image.data.insert(image.data.end(), rows, rows + std::size_t(count) * image.width);
    image.height += count;
  };
}

IndexedMapReader::IndexedMapReader(const FileRef& file, GreenAxis green, const FileRef& palette)
    : name_(file.name), source_(detail::open_indexed(file, detail::format_of(file), green)) {
  if (!source_) {
    ImageReader image(file);  // damaged, missing and foreign files say what they are
    throw file_error(
        ErrorKind::kMalformed, file.name,
        "expected an indexed normal map (EXR with a channel 'index', PNG with a palette, KTX2 or DDS), got " +
            std::to_string(image.channels()) + (image.channels() == 1 ? " channel" : " channels") + " of " +
            burnish::name(image.sample_type()));
  }
  const bool own = !source_->palette.normals.empty();
  if (own && !palette.empty())
    throw Error(ErrorKind::kUsage, "palette: '" + file.name + "' holds its own palette, and takes no other");
  if (!own && palette.empty())
    throw Error(ErrorKind::kUsage, "palette: expected the file of the palette of '" + file.name +
                                       "', which holds indices only, got nothing");
  if (own) detail::validate(source_->palette, file.name);
  else source_->palette = read_palette(palette, green);
}

IndexedMapReader::~IndexedMapReader() = default;
IndexedMapReader::IndexedMapReader(IndexedMapReader&&) noexcept = default;

const Palette& IndexedMapReader::palette() const { return source_->palette; }
int IndexedMapReader::width() const { return source_->width; }
int IndexedMapReader::height() const { return source_->height; }
int IndexedMapReader::levels() const { return source_->levels; }

void IndexedMapReader::read_rows(int level, int first, int count, std::uint16_t* out) {
  source_->read_rows(level, first, count, out);
  const std::size_t texels = std::size_t(level_size(source_->width, level)) * count;
  const std::size_t n = source_->palette.normals.size();
  if (const std::uint16_t most = *std::max_element(out, out + texels); most >= n)
    throw file_error(ErrorKind::kMalformed, name_,
                     "expected indices below " + std::to_string(n) + ", got " + std::to_string(most) + " in level " +
                         std::to_string(level));
}

void IndexedMapReader::check() {
  constexpr std::size_t kTexels = std::size_t(1) << 20;
  const int band = int(std::clamp<std::size_t>(kTexels / width(), 1, height()));
  std::vector<std::uint16_t> rows(std::size_t(width()) * band);
  for (int l = 0; l < levels(); l++)
    for (int y = 0, h = level_size(height(), l); y < h; y += band) read_rows(l, y, std::min(band, h - y), rows.data());
}

IndexedMapWriter::IndexedMapWriter(const FileRef& file, FileType type, const Palette& palette, int width, int height,
                                   int levels) {
  require_can_hold_levels(file, type, levels);
  const detail::IndexShape shape{palette, width, height, levels};
  target_ = type == FileType::kExr    ? detail::create_indexed_exr(file, shape)
            : type == FileType::kPng  ? detail::create_indexed_png(file, shape)
            : type == FileType::kKtx2 ? detail::create_indexed_ktx2(file, shape)
                                      : detail::create_indexed_dds(file, shape);
  for (int l = 0; l < levels; l++) rows_left_.push_back(level_size(height, l));
}

IndexedMapWriter::~IndexedMapWriter() = default;
IndexedMapWriter::IndexedMapWriter(IndexedMapWriter&&) noexcept = default;

void IndexedMapWriter::write_rows(int level, int count, const std::uint16_t* rows) {
  target_->write_rows(level, count, rows);
  rows_left_[level] -= count;
  if (std::ranges::all_of(rows_left_, [](int left) { return left == 0; })) target_->close();
}

}  // namespace burnish
