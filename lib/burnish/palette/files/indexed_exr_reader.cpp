#include <ImfChannelList.h>
#include <ImfInputFile.h>
#include <ImfTestFile.h>
#include <ImfTiledInputFile.h>

#include <algorithm>

#include "burnish/palette/files/exr_file.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

// 32-bit indices, since that is what the file holds, into 16 bits after a look at their size.
void narrow(const std::uint32_t* in, std::size_t count, std::uint16_t* out, const FileRef& file) {
  for (std::size_t i = 0; i < count; i++) {
    if (in[i] >= std::uint32_t(kMaxPaletteSize))
      throw file_error(ErrorKind::kMalformed, file.name, "expected indices below 65536, got " + std::to_string(in[i]));
    out[i] = std::uint16_t(in[i]);
  }
}

void require_sane_size(const Imf::Header& header, const FileRef& file) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t w = std::int64_t(window.max.x) - window.min.x + 1,
                     h = std::int64_t(window.max.y) - window.min.y + 1;
  if (window.min.x != 0 || window.min.y != 0 || w < 1 || h < 1 || w > 1 << 20 || h > 1 << 20 ||
      w * h > std::int64_t(1) << 32)
    throw file_error(ErrorKind::kMalformed, file.name, "expected a data window from (0,0) of sensible size");
  require_room_for(file, w, h, 16);  // halves are the smallest samples of an EXR
}

class ScanlineSource final : public IndexSource {
 public:
  explicit ScanlineSource(const FileRef& file) : file_(file), in_(file.path.c_str()) {
    require_sane_size(in_.header(), file);
    palette = extract_palette(in_.header(), file);
    const Imath::Box2i window = in_.header().dataWindow();
    width = window.max.x + 1, height = window.max.y + 1;
  }

  void read_rows(int, int first, int count, std::uint16_t* out) override {
    reading_exr(file_, [&] {
      constexpr int kRows = 256;
      for (int y = first; y < first + count; y += kRows, out += std::size_t(kRows) * width) {
        const int rows = std::min(kRows, first + count - y);
        band_.resize(std::size_t(rows) * width);
        in_.setFrameBuffer(frame_buffer(band_, width, y));
        in_.readPixels(y, y + rows - 1);
        narrow(band_.data(), band_.size(), out, file_);
      }
    });
  }

 private:
  FileRef file_;
  Imf::InputFile in_;
  std::vector<std::uint32_t> band_;
};

class TiledSource final : public IndexSource {
 public:
  explicit TiledSource(const FileRef& file) : file_(file), in_(file.path.c_str()) {
    require_sane_size(in_.header(), file);
    palette = extract_palette(in_.header(), file);
    if (in_.levelMode() == Imf::RIPMAP_LEVELS || in_.levelRoundingMode() != Imf::ROUND_DOWN)
      throw file_error(ErrorKind::kUnsupported, file.name, "expected mip levels rounded down");
    width = in_.levelWidth(0), height = in_.levelHeight(0), levels = in_.numLevels();
  }

  void read_rows(int level, int first, int count, std::uint16_t* out) override {
    reading_exr(file_, [&] {
      const int w = in_.levelWidth(level);
      for (const int end = first + count; first < end;) {
        if (level != level_ || first < first_ || first >= end_) load(level, first);
        const int rows = std::min(end, end_) - first;
        narrow(band_.data() + std::size_t(first - first_) * w, std::size_t(rows) * w, out, file_);
        first += rows, out += std::size_t(rows) * w;
      }
    });
  }

 private:
  // The tiles of a row, from that one on, and of as many below as make some work for threads.
  void load(int level, int row) {
    constexpr std::size_t kTexels = std::size_t(1) << 20;
    const int w = in_.levelWidth(level), tile = int(in_.tileYSize()), first = row / tile;
    const int tile_rows = int(std::max<std::size_t>(1, kTexels / (std::size_t(w) * tile)));
    const int last = std::min(first + tile_rows, in_.numYTiles(level)) - 1;
    level_ = -1;  // until it is whole
    first_ = first * tile, end_ = std::min((last + 1) * tile, in_.levelHeight(level));
    band_.resize(std::size_t(end_ - first_) * w);
    in_.setFrameBuffer(frame_buffer(band_, w, first_));
    in_.readTiles(0, in_.numXTiles(level) - 1, first, last, level);
    level_ = level;
  }

  FileRef file_;
  Imf::TiledInputFile in_;
  int level_ = -1, first_ = 0, end_ = 0;  // rows of a level that are held
  std::vector<std::uint32_t> band_;
};

}  // namespace

bool is_indexed_exr(const FileRef& file) {
  try {
    const Imf::InputFile in(file.path.c_str());
    return in.header().channels().findChannel(kIndexChannel) != nullptr;
  } catch (const std::exception&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_exr(const FileRef& file) {
  use_exr_threads();
  return reading_exr(file, [&]() -> std::unique_ptr<IndexSource> {
    if (Imf::isTiledOpenExrFile(file.path.c_str())) return std::make_unique<TiledSource>(file);
    return std::make_unique<ScanlineSource>(file);
  });
}

}  // namespace burnish::detail
