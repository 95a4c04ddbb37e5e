#include <ImfChannelList.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>
#include <optional>

#include "burnish/core/mip.h"
#include "burnish/core/waiting_levels.h"
#include "burnish/palette/files/exr_file.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

constexpr int kTile = 64;

Imf::Header header_of(const IndexShape& shape) {
  Imf::Header header(shape.width, shape.height);
  header.channels().insert(kIndexChannel, Imf::Channel(Imf::UINT));
  insert_palette(header, shape.palette);
  return header;
}

class ScanlineTarget final : public IndexTarget {
 public:
  ScanlineTarget(const FileRef& file, const IndexShape& shape) : stream_(file), width_(shape.width) {
    stream_.guard([&] { out_.emplace(stream_, header_of(shape)); });
  }

  void write_rows(int, int count, const std::uint16_t* rows) override {
    constexpr int kRows = 256;  // many blocks of 16 lines, so that threads have work, and no second copy of the map
    for (int y = 0; y < count; y += kRows) {
      const int n = std::min(kRows, count - y);
      const std::uint16_t* from = rows + std::size_t(y) * width_;
      band_.assign(from, from + std::size_t(n) * width_);
      stream_.guard([&] {
        out_->setFrameBuffer(frame_buffer(band_, width_, out_->currentScanLine()));
        out_->writePixels(n);
      });
    }
  }

  void close() override {
    stream_.guard([&] { out_.reset(); });
    stream_.close();
  }

 private:
  ExrStream stream_;
  std::optional<Imf::OutputFile> out_;
  int width_;
  std::vector<std::uint32_t> band_;
};

// Tiles lie in the file level by level, the base first, as other writers have them: what comes of coarser levels before
// the base is complete waits on disk.
class TiledTarget final : public IndexTarget {
 public:
  TiledTarget(const FileRef& file, const IndexShape& shape)
      : stream_(file),
        width_(shape.width),
        height_(shape.height),
        waiting_(file, shape.width, shape.height, shape.levels, sizeof(std::uint16_t)) {
    Imf::Header header = header_of(shape);
    header.setTileDescription(Imf::TileDescription(kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
    stream_.guard([&] { out_.emplace(stream_, header); });
    if (out_->numLevels() != shape.levels)
      throw file_error(ErrorKind::kUnsupported, file.name,
                       "EXR holds one level or all " + std::to_string(out_->numLevels()) + ", not " +
                           std::to_string(shape.levels) + " (--split writes any number)");
  }

  void write_rows(int level, int count, const std::uint16_t* rows) override {
    if (level == 0) write_level_rows(0, count, rows);
    else waiting_.append(level, count, rows);
  }

  void close() override {
    for (int level = 1; level < out_->numLevels(); level++) {
      constexpr int kRows = 8 * kTile;
      const int h = level_size(height_, level);
      std::vector<std::uint16_t> rows(std::size_t(level_size(width_, level)) * std::min(h, kRows));
      for (int y = 0; y < h; y += kRows) {
        const int n = std::min(kRows, h - y);
        waiting_.read(level, y, n, rows.data());
        write_level_rows(level, n, rows.data());
      }
    }
    stream_.guard([&] { out_.reset(); });
    stream_.close();
  }

 private:
  // The next rows of the level that is written: whole rows of tiles as soon as they are complete.
  void write_level_rows(int level, int count, const std::uint16_t* rows) {
    const int w = level_size(width_, level), h = level_size(height_, level);
    constexpr int kRows = 8 * kTile;  // so that threads have work
    while (count > 0) {
      const int held = int(band_.size() / w), n = std::min(count, kRows - held);
      band_.insert(band_.end(), rows, rows + std::size_t(n) * w);
      rows += std::size_t(n) * w, count -= n;
      const int end = first_ + held + n;
      if (end < h && end % kRows != 0) return;
      stream_.guard([&] {
        out_->setFrameBuffer(frame_buffer(band_, w, first_));
        out_->writeTiles(0, out_->numXTiles(level) - 1, first_ / kTile, (end - 1) / kTile, level);
      });
      band_.clear();
      first_ = end < h ? end : 0;
    }
  }

  ExrStream stream_;
  std::optional<Imf::TiledOutputFile> out_;
  int width_, height_;
  WaitingLevels waiting_;
  int first_ = 0;  // row of band_ in the level that is written
  std::vector<std::uint32_t> band_;
};

}  // namespace

std::unique_ptr<IndexTarget> create_indexed_exr(const FileRef& file, const IndexShape& shape) {
  use_exr_threads();
  if (shape.levels == 1) return std::make_unique<ScanlineTarget>(file, shape);
  return std::make_unique<TiledTarget>(file, shape);
}

}  // namespace burnish::detail
