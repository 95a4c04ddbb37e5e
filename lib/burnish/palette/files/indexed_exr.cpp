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

#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
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
  explicit CheckedStream(const FileRef& file) : OStream(file.name.c_str()), file_(file.path), name_(file.name) {
    check();
  }
  void write(const char bytes[], int n) override {
    file_.write(bytes, std::size_t(n));
    check();
  }
  std::uint64_t tellp() override { return std::uint64_t(file_.position()); }
  void seekp(std::uint64_t position) override { file_.seek(std::int64_t(position)); }
  // After what writes to it is gone.
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (file_.first_error()) throw file_.error(name_);
  }
  CheckedFile file_;
  std::string name_;
};

// Runs body(stream) and sees to it that all of it has reached the disk.
template <typename Body>
void write_checked(const FileRef& file, const Body& body) {
  Imf::setGlobalThreadCount(thread_limit() > 1 ? thread_limit() : 0);
  CheckedStream stream(file);
  try {
    body(stream);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    stream.close();  // says why, if it was the disk
    throw file_error(ErrorKind::kIo, file.name, "cannot be written: " + codec_message(error.what(), file));
  }
  stream.close();
}

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

// Rows of 32-bit indices, since that is what the file holds, into 16 bits after a look at their size.
void narrow(const std::vector<std::uint32_t>& in, IndexImage& out, const FileRef& file) {
  for (std::size_t i = 0; i < in.size(); i++) {
    if (in[i] >= std::uint32_t(kMaxPaletteSize))
      throw file_error(ErrorKind::kMalformed, file.name, "expected indices below 65536, got " + std::to_string(in[i]));
    out.data[i] = std::uint16_t(in[i]);
  }
}

Imf::FrameBuffer frame_buffer(std::uint32_t* data, int width, int first_row) {
  Imf::FrameBuffer buffer;
  char* base = reinterpret_cast<char*>(data) - sizeof(std::uint32_t) * std::ptrdiff_t(first_row) * width;
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

}  // namespace

bool is_indexed_exr(const FileRef& file) {
  try {
    const Imf::InputFile in(file.path.c_str());
    return in.header().channels().findChannel(kChannel) != nullptr;
  } catch (const std::exception&) {
    return false;  // whoever reads it says what is wrong
  }
}

IndexedMap read_indexed_exr(const FileRef& file) {
  Imf::setGlobalThreadCount(thread_limit() > 1 ? thread_limit() : 0);
  try {
    IndexedMap map;
    const bool tiled = Imf::isTiledOpenExrFile(file.path.c_str());
    if (!tiled) {
      Imf::InputFile in(file.path.c_str());
      require_sane_size(in.header(), file);
      map.palette = extract_palette(in.header(), file);
      const Imath::Box2i window = in.header().dataWindow();
      map.levels.emplace_back(window.max.x + 1, window.max.y + 1);
      IndexImage& level = map.levels.back();
      constexpr int kRows = 256;
      std::vector<std::uint32_t> band;
      for (int y = 0; y < level.height; y += kRows) {
        const int rows = std::min(kRows, level.height - y);
        IndexImage part(level.width, rows);
        band.resize(part.texels());
        in.setFrameBuffer(frame_buffer(band.data(), level.width, y));
        in.readPixels(y, y + rows - 1);
        narrow(band, part, file);
        std::ranges::copy(part.data, level.row(y));
      }
    } else {
      Imf::TiledInputFile in(file.path.c_str());
      require_sane_size(in.header(), file);
      map.palette = extract_palette(in.header(), file);
      if (in.levelMode() == Imf::RIPMAP_LEVELS || in.levelRoundingMode() != Imf::ROUND_DOWN)
        throw file_error(ErrorKind::kUnsupported, file.name, "expected mip levels rounded down");
      for (int l = 0; l < in.numLevels(); l++) {
        map.levels.emplace_back(in.levelWidth(l), in.levelHeight(l));
        IndexImage& level = map.levels.back();
        std::vector<std::uint32_t> texels(level.texels());
        in.setFrameBuffer(frame_buffer(texels.data(), level.width, 0));
        in.readTiles(0, in.numXTiles(l) - 1, 0, in.numYTiles(l) - 1, l);
        narrow(texels, level, file);
      }
    }
    return map;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw codec_error(file, error);
  }
}

void write_indexed_exr(const FileRef& file, const IndexedMap& map) {
  Imf::Header header(map.width(), map.height());
  header.channels().insert(kChannel, Imf::Channel(Imf::UINT));
  insert_palette(header, map.palette);
  write_checked(file, [&](CheckedStream& stream) {
    if (map.levels.size() == 1) {
      Imf::OutputFile out(stream, header);
      constexpr int kRows = 256;  // many blocks of 16 lines, so that threads have work, and no second copy of the map
      std::vector<std::uint32_t> band;
      for (int y = 0; y < map.height(); y += kRows) {
        const int rows = std::min(kRows, map.height() - y);
        band.assign(map.levels[0].row(y), map.levels[0].row(y) + std::size_t(rows) * map.width());
        out.setFrameBuffer(frame_buffer(band.data(), map.width(), y));
        out.writePixels(rows);
      }
      return;
    }
    header.setTileDescription(Imf::TileDescription(kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
    Imf::TiledOutputFile out(stream, header);
    if (out.numLevels() != int(map.levels.size()))
      throw file_error(ErrorKind::kUnsupported, file.name,
                       "EXR holds one level or all " + std::to_string(out.numLevels()) + ", not " +
                           std::to_string(map.levels.size()) + " (--split writes any number)");
    for (int l = 0; l < out.numLevels(); l++) {
      const IndexImage& level = map.levels[l];
      constexpr int kTileRows = 8;
      for (int ty = 0; ty < out.numYTiles(l); ty += kTileRows) {
        const int last = std::min(ty + kTileRows, out.numYTiles(l)) - 1;
        const int first_row = ty * kTile, end_row = std::min(level.height, (last + 1) * kTile);
        std::vector<std::uint32_t> band(level.row(first_row),
                                        level.row(first_row) + std::size_t(end_row - first_row) * level.width);
        out.setFrameBuffer(frame_buffer(band.data(), level.width, first_row));
        out.writeTiles(0, out.numXTiles(l) - 1, ty, last, l);
      }
    }
  });
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
  write_checked(file, [&](CheckedStream& stream) {
    Imf::OutputFile out(stream, header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  });
}

}  // namespace burnish::detail
