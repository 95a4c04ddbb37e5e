// The module (openimageio.h): OpenImageIO's inputs and outputs as sources and sinks.
#include "burnish/core/codecs/openimageio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"

namespace burnish::detail {
namespace {

OIIO::TypeDesc to_oiio(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::kUint16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::kHalf:
      return OIIO::TypeDesc::HALF;
    default:
      return OIIO::TypeDesc::FLOAT;
  }
}

SampleType nearest_sample(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
      return SampleType::kUint8;
    case OIIO::TypeDesc::HALF:
      return SampleType::kHalf;
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE:
      return SampleType::kFloat;
    default:
      return SampleType::kUint16;
  }
}

Attributes attributes_of(const OIIO::ImageSpec& spec) {
  Attributes attributes;
  for (const OIIO::ParamValue& a : spec.extra_attribs) {
    const OIIO::TypeDesc type = a.type();
    if (type == OIIO::TypeDesc(OIIO::TypeDesc::STRING)) {
      attributes.emplace_back(std::string(a.name()), a.get_string());
    } else if (type.basetype == OIIO::TypeDesc::FLOAT) {
      const auto* floats = static_cast<const float*>(a.data());
      attributes.emplace_back(std::string(a.name()),
                              std::vector<double>(floats, floats + type.numelements() * type.aggregate));
    }
  }
  return attributes;
}

class Source final : public ImageSource {
 public:
  Source(const FileRef& file, const std::string& codec) : file_(file), in_(OIIO::ImageInput::create(codec)) {
    if (!in_) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + codec);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!in_->open(file.path, spec_, config)) fail();
    if (spec_.depth > 1 || spec_.deep)
      throw file_error(ErrorKind::kUnsupported, file.name, "expected a flat image, got a volume or deep image");
    require_whole(file_,
                  spec_.x == spec_.full_x && spec_.y == spec_.full_y && spec_.width == spec_.full_width &&
                      spec_.height == spec_.full_height,
                  {spec_.width, spec_.height}, {spec_.full_width, spec_.full_height});
    require_room_for_tiles();
    form_.width = spec_.width, form_.height = spec_.height;
    form_.channel_names = spec_.channelnames;
    form_.sample = nearest_sample(spec_.format);
    form_.integer = !spec_.format.is_floating_point();
    form_.exact = spec_.format == to_oiio(form_.sample) && spec_.channelformats.empty();
    form_.texel_bytes = spec_.pixel_bytes(true);
    form_.attributes = attributes_of(spec_);
  }

  void read_rows(int first, int count, float* out) override { read(first, count, OIIO::TypeDesc::FLOAT, out); }
  void read_rows_stored(int first, int count, void* out) override { read(first, count, spec_.format, out); }

  int levels() override {
    int n = 1;
    while (in_->seek_subimage(0, n)) n++;  // of TIFF, spec() gives one for any number
    in_->geterror();                       // that there is no further one is no failure
    return n;
  }
  LevelSize level_size(int level) override {
    const OIIO::ImageSpec spec = in_->spec_dimensions(0, level);
    if (spec.nchannels != spec_.nchannels) fail();
    return {spec.width, spec.height};
  }
  void read_level(int level, float* out) override {
    if (!in_->read_image(0, level, 0, spec_.nchannels, OIIO::TypeDesc::FLOAT, out) || in_->has_error()) fail();
  }

 private:
  [[noreturn]] void fail() {
    const std::string what = codec_message(in_->geterror(), file_);
    throw file_error(ErrorKind::kMalformed, file_.name, what.empty() ? "is damaged or cut short" : what);
  }

  // Tiles are decoded whole, however much larger than the image they say they are; few texels are too few to matter.
  void require_room_for_tiles() const {
    constexpr std::uintmax_t kMostInByte = 8 * 1032, kFew = 1 << 16;
    const std::uintmax_t texels = spec_.tile_pixels();
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file_.path, unknown);
    if (!unknown && texels > kFew && texels / kMostInByte > bytes)
      throw file_error(ErrorKind::kMalformed, file_.name,
                       "is too short for tiles of " + std::to_string(spec_.tile_width) + "x" +
                           std::to_string(spec_.tile_height) + " texels");
  }

  void read(int first, int count, OIIO::TypeDesc type, void* out) {
    const std::size_t row_samples = std::size_t(spec_.width) * spec_.nchannels, row_bytes = row_samples * type.size();
    const int y0 = spec_.y;
    if (spec_.tile_width == 0) {
      // The TIFF codec reports success for strips that the file is too short for, and leaves a message.
      if (!in_->read_scanlines(0, 0, y0 + first, y0 + first + count, 0, 0, spec_.nchannels, type, out) ||
          in_->has_error())
        fail();
      return;
    }
    for (int y = first; y < first + count;) {
      const int tile_first = y / spec_.tile_height * spec_.tile_height;
      if (tile_first != tiles_first_) read_tiles(tile_first);
      const int end = std::min({first + count, tile_first + spec_.tile_height, spec_.height});
      const std::byte* from = tiles_.data() + row_samples * tiles_type_.size() * (y - tile_first);
      std::byte* to = static_cast<std::byte*>(out) + row_bytes * (y - first);
      if (type == tiles_type_) std::memcpy(to, from, row_bytes * (end - y));
      else OIIO::convert_pixel_values(tiles_type_, from, type, to, int(row_samples * (end - y)));
      y = end;
    }
  }

  void read_tiles(int first) {
    const int end = std::min(first + spec_.tile_height, spec_.height);
    tiles_type_ = spec_.channelformats.empty() ? spec_.format : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
    tiles_.resize(std::size_t(spec_.width) * spec_.nchannels * tiles_type_.size() * spec_.tile_height);
    tiles_first_ = -1;
    if (!in_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, spec_.y + first, spec_.y + end, 0, 1, 0, spec_.nchannels,
                         tiles_type_, tiles_.data()) ||
        in_->has_error())
      fail();
    tiles_first_ = first;
  }

  FileRef file_;
  std::unique_ptr<OIIO::ImageInput> in_;
  OIIO::ImageSpec spec_;
  // Of a tiled file, the row of tiles that was read last, as stored: so it takes the least room.
  std::vector<std::byte> tiles_;
  int tiles_first_ = -1;
  OIIO::TypeDesc tiles_type_;  // float where channels are of several types
};

// A CheckedFile as OpenImageIO's codecs take it: most of them look at no result of their own writes.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedProxy(const std::string& path) : IOProxy(path, Write), file(path) {}

  const char* proxytype() const override { return "file"; }
  bool opened() const override { return file.is_open(); }
  void close() override { file.close(); }
  std::size_t write(const void* bytes, std::size_t size) override {
    file.seek(m_pos);
    const std::size_t n = file.write(bytes, size);
    m_pos = file.position();
    return n;
  }
  std::size_t read(void* bytes, std::size_t size) override {
    file.seek(m_pos);
    const std::size_t n = file.read(bytes, size);
    m_pos = file.position();
    return n;
  }
  std::size_t size() const override { return file.size(); }

  CheckedFile file;
};

class Sink final : public ImageSink {
 public:
  Sink(const FileRef& file, FileType type, const ImageShape& shape)
      : file_(file),
        to_(file.path),
        out_(OIIO::ImageOutput::create(type == FileType::kTga   ? "targa"
                                       : type == FileType::kBmp ? "bmp"
                                                                : "tiff")),
        spec_(shape.width, shape.height, shape.channels(), to_oiio(shape.sample)) {
    if (!out_) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + std::string(name(type)));
    require(true);
    spec_.channelnames = shape.channel_names;
    if (type == FileType::kTiff) spec_.attribute("compression", "zip");
    spec_.attribute("oiio:UnassociatedAlpha", 1);
    spec_.attribute("DateTime", "");  // or the codec puts the clock into the file
    for (const auto& [name, value] : shape.attributes) spec_.attribute(name, std::get<std::string>(value));
    OIIO::Filesystem::IOProxy* to = &to_;
    spec_.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &to);
    require(out_->open(file_.path, spec_));
  }

  void write_rows(int count, const void* rows) override {
    require(out_->write_scanlines(next_, next_ + count, 0, spec_.format, rows));
    next_ += count;
  }
  void close() override {
    require(out_->close());
    out_.reset();  // some files are complete only now
    to_.file.close();
    require(true);
  }

 private:
  // Throws what went wrong, if anything did.
  void require(bool ok) {
    if (ok && !to_.file.first_error()) return;
    throw to_.file.error(file_.name, out_ ? codec_message(out_->geterror(), file_) : "");
  }

  FileRef file_;
  CheckedProxy to_;  // outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> out_;
  OIIO::ImageSpec spec_;
  int next_ = 0;
};

// Its pool has a thread less, and strips are deflated side by side only where it has two.
void use_threads(int threads) { OIIO::attribute("threads", threads > 1 ? std::max(threads, 3) : 1); }

}  // namespace
}  // namespace burnish::detail

extern "C" const burnish::detail::OpenImageIo burnish_openimageio{
    [](const burnish::FileRef& file, const std::string& codec,
       int threads) -> std::unique_ptr<burnish::detail::ImageSource> {
      burnish::detail::use_threads(threads);
      return std::make_unique<burnish::detail::Source>(file, codec);
    },
    [](const burnish::FileRef& file, burnish::FileType type, const burnish::detail::ImageShape& shape,
       int threads) -> std::unique_ptr<burnish::detail::ImageSink> {
      burnish::detail::use_threads(threads);
      return std::make_unique<burnish::detail::Sink>(file, type, shape);
    }};
