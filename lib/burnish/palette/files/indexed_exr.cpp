#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/image_chain.h"
#include "burnish/core/mip.h"
#include "burnish/palette/files/exr_palette.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

// Rows that make some work for threads, and no second copy of the map.
int rows_at_once(int width) { return std::max(64, (1 << 18) / width); }

// 32-bit indices, since that is what the file holds, into 16 bits after a look at their size.
void narrow(const std::vector<std::uint32_t>& in, std::uint16_t* out, const FileRef& file) {
  for (const std::uint32_t index : in) {
    if (index >= std::uint32_t(kMaxPaletteSize))
      throw file_error(ErrorKind::kMalformed, file.name, "expected indices below 65536, got " + std::to_string(index));
    *out++ = std::uint16_t(index);
  }
}

class ExrSource final : public IndexSource {
 public:
  explicit ExrSource(const FileRef& file) : file_(file), in_(file) {
    require_sane_size();
    if (std::ranges::find(in_.channels(), kIndexChannel, &ExrChannel::name)->type != ExrType::kUint)
      throw file_error(ErrorKind::kMalformed, file.name, "expected unsigned integers in the channel index");
    palette = extract_palette(in_, file);
    if (!in_.rounds_down()) throw file_error(ErrorKind::kUnsupported, file.name, "expected mip levels rounded down");
    width = in_.width(), height = in_.height(), levels = in_.levels();
  }

  void read_rows(int level, int first, int count, std::uint16_t* out) override {
    const int w = in_.width(level), at_once = rows_at_once(w);
    for (const int end = first + count; first < end; first += at_once) {
      const int some = std::min(at_once, end - first);
      band_.resize(std::size_t(some) * w);
      in_.read_rows(level, first, some,
                    {{kIndexChannel, ExrType::kUint, band_.data(), sizeof(std::uint32_t), sizeof(std::uint32_t) * w}});
      narrow(band_, out, file_);
      out += band_.size();
    }
  }

 private:
  void require_sane_size() const {
    constexpr std::int64_t kMost = 1 << 20;
    const std::int64_t w = in_.width(), h = in_.height();
    if (in_.windows().x != 0 || in_.windows().y != 0 || w > kMost || h > kMost || w * h > std::int64_t(1) << 32)
      throw file_error(ErrorKind::kMalformed, file_.name, "expected a data window from (0,0) of sensible size");
    require_room_for(file_, w, h, 16);  // halves are the smallest samples of an EXR
  }

  FileRef file_;
  ExrReader in_;
  std::vector<std::uint32_t> band_;
};

class ExrTarget final : public IndexTarget {
 public:
  ExrTarget(const FileRef& file, const IndexShape& shape)
      : out_(file, {shape.width,
                    shape.height,
                    shape.levels,
                    {kIndexChannel},
                    ExrType::kUint,
                    palette_attributes(shape.palette),
                    kIndexZipLevel}),
        width_(shape.width) {}

  void write_rows(int level, int count, const std::uint16_t* rows) override {
    const int w = level_size(width_, level), at_once = rows_at_once(w);
    for (; count > 0; count -= at_once) {
      const int some = std::min(at_once, count);
      band_.assign(rows, rows + std::size_t(some) * w);
      out_.write_rows(level, some, band_.data());
      rows += band_.size();
    }
  }
  void close() override { out_.close(); }

 private:
  ExrWriter out_;
  int width_;
  std::vector<std::uint32_t> band_;
};

}  // namespace

bool is_indexed_exr(const FileRef& file) {
  try {
    const ExrReader in(file);
    return std::ranges::find(in.channels(), kIndexChannel, &ExrChannel::name) != in.channels().end();
  } catch (const Error&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_exr(const FileRef& file) { return std::make_unique<ExrSource>(file); }

std::unique_ptr<IndexTarget> create_indexed_exr(const FileRef& file, const IndexShape& shape) {
  require_chain(file, shape.width, shape.height, shape.levels);
  return std::make_unique<ExrTarget>(file, shape);
}

}  // namespace burnish::detail
