#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <cstring>

#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/codecs/exr_call.h"
#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/waiting_levels.h"

namespace burnish::detail {
namespace {

constexpr int kTile = 64;

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
    } catch (const std::bad_alloc&) {
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

template <typename T>
void insert_floats(Imf::Header& header, const std::string& name, const std::vector<float>& floats) {
  T value;
  std::memcpy(static_cast<void*>(&value), floats.data(), sizeof value);
  header.insert(name, Imf::TypedAttribute<T>(value));
}

void insert(Imf::Header& header, const std::string& name, const ExrValue& value, bool short_vectors) {
  if (const auto* text = std::get_if<std::string>(&value)) return header.insert(name, Imf::StringAttribute(*text));
  if (const auto* number = std::get_if<int>(&value)) return header.insert(name, Imf::IntAttribute(*number));
  const auto& floats = std::get<std::vector<float>>(value);
  switch (short_vectors ? floats.size() : 0) {
    case 1:
      return insert_floats<float>(header, name, floats);
    case 2:
      return insert_floats<Imath::V2f>(header, name, floats);
    case 3:
      return insert_floats<Imath::V3f>(header, name, floats);
    case 9:
      return insert_floats<Imath::M33f>(header, name, floats);
    case 16:
      return insert_floats<Imath::M44f>(header, name, floats);
    default:
      return header.insert(name, Imf::FloatVectorAttribute(floats));
  }
}

Imf::Header header_of(const ExrForm& form) {
  Imf::Header header(form.width, form.height);
  for (const std::string& channel : form.channels) header.channels().insert(channel, Imf::Channel(to_imf(form.type)));
  for (const auto& [name, value] : form.attributes) insert(header, name, value, form.short_vectors);
  header.compression() = Imf::ZIP_COMPRESSION;
  if (form.zip_level) header.zipCompressionLevel() = *form.zip_level;
  if (form.levels > 1)
    header.setTileDescription(Imf::TileDescription(kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
  return header;
}

}  // namespace

struct ExrWriter::Impl {
  ExrForm form;
  std::size_t texel_bytes;
  CheckedStream stream;
  std::optional<Imf::OutputFile> lines;  // one of the two
  std::optional<Imf::TiledOutputFile> tiles;
  std::optional<WaitingLevels> waiting;
  std::vector<char> band;  // rows of the level that is written, not yet enough to be put
  int band_first = 0;

  Impl(const FileRef& file, const ExrForm& of)
      : form(of), texel_bytes(size_of(form.type) * form.channels.size()), stream(file) {
    const Imf::Header header = header_of(form);
    if (form.levels > 1) waiting.emplace(file, form.width, form.height, form.levels, texel_bytes);
    stream.guard([&] { form.levels > 1 ? void(tiles.emplace(stream, header)) : void(lines.emplace(stream, header)); });
  }

  // Of rows that are the image's from `first` on.
  Imf::FrameBuffer frame_buffer(const void* rows, int width, int first) const {
    const std::size_t row_bytes = texel_bytes * width;
    char* base = static_cast<char*>(const_cast<void*>(rows)) - std::ptrdiff_t(row_bytes) * first;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < form.channels.size(); c++)
      buffer.insert(form.channels[c],
                    Imf::Slice(to_imf(form.type), base + c * size_of(form.type), texel_bytes, row_bytes));
    return buffer;
  }

  // Blocks of lines and rows of tiles that make some work for threads.
  int rows_at_once(int width) const {
    constexpr std::size_t kBytes = std::size_t(1) << 22;
    return kTile * int(std::max<std::size_t>(1, kBytes / (texel_bytes * width * kTile)));
  }

  // The next rows of the level that is written.
  void write(int level, int count, const char* rows) {
    const int w = level_size(form.width, level), h = level_size(form.height, level), at_once = rows_at_once(w);
    const std::size_t row_bytes = texel_bytes * w;
    while (count > 0) {
      const int held = int(band.size() / row_bytes), n = std::min(count, at_once - held), end = band_first + held + n;
      band.insert(band.end(), rows, rows + row_bytes * n);
      rows += row_bytes * n, count -= n;
      if (end < h && held + n < at_once) return;
      stream.guard([&] { put(level, end, frame_buffer(band.data(), w, band_first)); });
      band.clear();
      band_first = end < h ? end : 0;
    }
  }
  void put(int level, int end, const Imf::FrameBuffer& rows) {
    if (lines) {
      lines->setFrameBuffer(rows);
      lines->writePixels(end - band_first);
    } else {
      tiles->setFrameBuffer(rows);
      tiles->writeTiles(0, tiles->numXTiles(level) - 1, band_first / kTile, (end - 1) / kTile, level);
    }
  }

  void write_waiting() {
    for (int level = 1; level < form.levels; level++) {
      const int w = level_size(form.width, level), h = level_size(form.height, level), at_once = rows_at_once(w);
      std::vector<char> rows(texel_bytes * w * std::min(h, at_once));
      for (int y = 0; y < h; y += at_once) {
        const int n = std::min(at_once, h - y);
        waiting->read(level, y, n, rows.data());
        write(level, n, rows.data());
      }
    }
  }
};

ExrWriter::ExrWriter(const FileRef& file, const ExrForm& form) {
  use_exr_threads();
  impl_ = std::make_unique<Impl>(file, form);
}
ExrWriter::~ExrWriter() = default;

void ExrWriter::write_rows(int level, int count, const void* rows) {
  if (level == 0) impl_->write(0, count, static_cast<const char*>(rows));
  else impl_->waiting->append(level, count, rows);
}

void ExrWriter::close() {
  if (impl_->waiting) impl_->write_waiting();
  impl_->stream.guard([&] { impl_->lines.reset(), impl_->tiles.reset(); });
  impl_->stream.close();
}

}  // namespace burnish::detail
