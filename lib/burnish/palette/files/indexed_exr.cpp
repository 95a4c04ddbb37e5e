// Indexed maps in OpenEXR, through its own API: what OpenImageIO does to unsigned integer channels and to the
// attributes of mip chains would change them.
#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <ImfThreading.h>
#include <ImfTiledInputFile.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/parallel.h"
#include "burnish/core/spill_file.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

constexpr const char* kChannel = "index";
constexpr int kTile = 64;

Error codec_error(const FileRef& file, const std::exception& error) {
  return file_error(ErrorKind::kMalformed, file.name, codec_message(error.what(), file));
}

// A CheckedFile as the library takes it; its own stream passes over a full disk when it closes.
class CheckedStream final : public Imf::OStream {
 public:
  explicit CheckedStream(const FileRef& file) : OStream(file.name.c_str()), ref_(file), file_(file.path) { check(); }
  void write(const char bytes[], int n) override {
    file_.write(bytes, std::size_t(n));
    check();
  }
  std::uint64_t tellp() override { return std::uint64_t(file_.position()); }
  void seekp(std::uint64_t position) override { file_.seek(std::int64_t(position)); }
  // Runs what writes to it through the library.
  template <typename Body>
  void guard(const Body& body) {
    try {
      body();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      close();  // says why, if it was the disk
      throw file_error(ErrorKind::kIo, ref_.name, "cannot be written: " + codec_message(error.what(), ref_));
    }
  }
  // After what writes to it is gone: sees to it that all has reached the disk.
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (file_.first_error()) throw file_.error(ref_.name);
  }
  FileRef ref_;
  CheckedFile file_;
};

void use_threads() { Imf::setGlobalThreadCount(thread_limit() > 1 ? thread_limit() : 0); }

void insert_palette(Imf::Header& header, const Palette& palette) {
  std::vector<float> flat;
  flat.reserve(palette.normals.size() * 3);
  for (const Vec3f& n : palette.normals) flat.insert(flat.end(), {n.x, n.y, n.z});
  header.insert("burnish:palette", Imf::FloatVectorAttribute(flat));
  header.insert("burnish:materials", Imf::StringAttribute(materials_to_json(palette.materials)));
  header.insert("burnish:space", Imf::StringAttribute(name(palette.space)));
  header.insert("burnish:y", Imf::StringAttribute("up"));
  header.insert("burnish:format", Imf::IntAttribute(1));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 2;  // of indices, higher levels save 4 % and cost half as much time again
}

Palette extract_palette(const Imf::Header& header, const FileRef& file) {
  const auto* flat = header.findTypedAttribute<Imf::FloatVectorAttribute>("burnish:palette");
  const auto* materials = header.findTypedAttribute<Imf::StringAttribute>("burnish:materials");
  if (!flat || flat->value().size() % 3 != 0)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected a palette of normals in the attribute burnish:palette");
  const auto* format = header.findTypedAttribute<Imf::IntAttribute>("burnish:format");
  if (format && format->value() != 1)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected burnish:format 1, got " + std::to_string(format->value()));
  Palette palette;
  for (std::size_t i = 0; i < flat->value().size(); i += 3)
    palette.normals.push_back({flat->value()[i], flat->value()[i + 1], flat->value()[i + 2]});
  palette.materials = materials ? materials_from_json(materials->value(), file.name)
                                : std::vector<MaterialInterval>{{0, 0, int(palette.normals.size())}};
  if (const auto* space = header.findTypedAttribute<Imf::StringAttribute>("burnish:space"))
    palette.space = space_from_name(space->value(), file.name);
  if (const auto* y = header.findTypedAttribute<Imf::StringAttribute>("burnish:y")) require_y_up(y->value(), file.name);
  validate(palette, file.name);
  return palette;
}

// 32-bit indices, since that is what the file holds, into 16 bits after a look at their size.
void narrow(const std::uint32_t* in, std::size_t count, std::uint16_t* out, const FileRef& file) {
  for (std::size_t i = 0; i < count; i++) {
    if (in[i] >= std::uint32_t(kMaxPaletteSize))
      throw file_error(ErrorKind::kMalformed, file.name, "expected indices below 65536, got " + std::to_string(in[i]));
    out[i] = std::uint16_t(in[i]);
  }
}

// Whose first row is that one of the image.
Imf::FrameBuffer frame_buffer(std::vector<std::uint32_t>& data, int width, int first_row) {
  Imf::FrameBuffer buffer;
  char* base = reinterpret_cast<char*>(data.data()) - sizeof(std::uint32_t) * std::ptrdiff_t(first_row) * width;
  buffer.insert(kChannel, Imf::Slice(Imf::UINT, base, sizeof(std::uint32_t), sizeof(std::uint32_t) * width));
  return buffer;
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

// Runs what calls the library on a file that is read.
template <typename Body>
auto reading(const FileRef& file, const Body& body) {
  try {
    return body();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw codec_error(file, error);
  }
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
    reading(file_, [&] {
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
    reading(file_, [&] {
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

Imf::Header header_of(const IndexShape& shape) {
  Imf::Header header(shape.width, shape.height);
  header.channels().insert(kChannel, Imf::Channel(Imf::UINT));
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
  CheckedStream stream_;
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
        waiting_(std::filesystem::path(file.path).parent_path().string()) {
    Imf::Header header = header_of(shape);
    header.setTileDescription(Imf::TileDescription(kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
    stream_.guard([&] { out_.emplace(stream_, header); });
    if (out_->numLevels() != shape.levels)
      throw file_error(ErrorKind::kUnsupported, file.name,
                       "EXR holds one level or all " + std::to_string(out_->numLevels()) + ", not " +
                           std::to_string(shape.levels) + " (--split writes any number)");
    for (int l = 0; l < shape.levels; l++) next_.push_back(bytes_before(l));
  }

  void write_rows(int level, int count, const std::uint16_t* rows) override {
    if (level == 0) return write_level_rows(0, count, rows);
    const std::size_t bytes = row_bytes(level) * count;
    waiting_.write(next_[level], rows, bytes);
    next_[level] += bytes;
  }

  void close() override {
    for (int level = 1; level < out_->numLevels(); level++) {
      constexpr int kRows = 8 * kTile;
      const int h = level_size(height_, level);
      std::vector<std::uint16_t> rows(std::size_t(level_size(width_, level)) * std::min(h, kRows));
      for (int y = 0; y < h; y += kRows) {
        const int n = std::min(kRows, h - y);
        waiting_.read(bytes_before(level) + row_bytes(level) * y, rows.data(), row_bytes(level) * n);
        write_level_rows(level, n, rows.data());
      }
    }
    stream_.guard([&] { out_.reset(); });
    stream_.close();
  }

 private:
  std::size_t row_bytes(int level) const { return sizeof(std::uint16_t) * level_size(width_, level); }
  // Of the levels from 1 on, where they wait.
  std::size_t bytes_before(int level) const {
    std::size_t bytes = 0;
    for (int l = 1; l < level; l++) bytes += row_bytes(l) * level_size(height_, l);
    return bytes;
  }

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

  CheckedStream stream_;
  std::optional<Imf::TiledOutputFile> out_;
  int width_, height_;
  SpillFile waiting_;              // the levels from 1 on
  std::vector<std::size_t> next_;  // where in it the next row of each goes
  int first_ = 0;                  // row of band_ in the level that is written
  std::vector<std::uint32_t> band_;
};

}  // namespace

bool is_indexed_exr(const FileRef& file) {
  try {
    const Imf::InputFile in(file.path.c_str());
    return in.header().channels().findChannel(kChannel) != nullptr;
  } catch (const std::exception&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_exr(const FileRef& file) {
  use_threads();
  return reading(file, [&]() -> std::unique_ptr<IndexSource> {
    if (Imf::isTiledOpenExrFile(file.path.c_str())) return std::make_unique<TiledSource>(file);
    return std::make_unique<ScanlineSource>(file);
  });
}

std::unique_ptr<IndexTarget> create_indexed_exr(const FileRef& file, const IndexShape& shape) {
  use_threads();
  if (shape.levels == 1) return std::make_unique<ScanlineTarget>(file, shape);
  return std::make_unique<TiledTarget>(file, shape);
}

std::optional<Palette> read_palette_exr(const FileRef& file) {
  try {
    const Imf::InputFile in(file.path.c_str());
    if (!in.header().findTypedAttribute<Imf::FloatVectorAttribute>("burnish:palette")) return std::nullopt;
    return extract_palette(in.header(), file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw codec_error(file, error);
  }
}

void write_palette_exr(const FileRef& file, const Palette& palette) {
  const int n = int(palette.normals.size());
  Imf::Header header(n, 1);
  for (const char* channel : {"R", "G", "B"}) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  insert_palette(header, palette);
  Imf::FrameBuffer buffer;
  char* base = reinterpret_cast<char*>(const_cast<Vec3f*>(palette.normals.data()));
  for (int c = 0; c < 3; c++)
    buffer.insert(std::string(1, "RGB"[c]),
                  Imf::Slice(Imf::FLOAT, base + c * sizeof(float), sizeof(Vec3f), sizeof(Vec3f) * n));
  use_threads();
  CheckedStream stream(file);
  stream.guard([&] {
    Imf::OutputFile out(stream, header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  });
  stream.close();
}

}  // namespace burnish::detail
