#include "burnish/core/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"

namespace burnish {
namespace {

struct FileTypeInfo {
  FileType type;
  const char* name;
  const char* codec;
  std::vector<const char*> extensions;
  SampleType default_sample;
  std::vector<SampleType> samples;
};

const std::vector<FileTypeInfo>& file_types() {
  using enum SampleType;
  static const std::vector<FileTypeInfo> table{
      {FileType::kPng, "PNG", "png", {".png"}, kUint8, {kUint8, kUint16}},
      {FileType::kTga, "TGA", "targa", {".tga"}, kUint8, {kUint8}},
      {FileType::kBmp, "BMP", "bmp", {".bmp"}, kUint8, {kUint8}},
      {FileType::kTiff, "TIFF", "tiff", {".tif", ".tiff"}, kUint16, {kUint8, kUint16, kFloat}},
      {FileType::kExr, "EXR", "openexr", {".exr"}, kHalf, {kHalf, kFloat}},
      {FileType::kKtx2, "KTX2", "", {".ktx2"}, kUint8, {}},
      {FileType::kDds, "DDS", "", {".dds"}, kUint8, {}},
  };
  return table;
}

const FileTypeInfo& info_of(FileType type) { return *std::ranges::find(file_types(), type, &FileTypeInfo::type); }

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

std::size_t sample_bytes(SampleType type) { return to_oiio(type).size(); }

std::string one_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// The codec a file's first bytes ask for, whatever its name says; empty where they tell nothing (TGA has no
// signature).
std::string codec_from_signature(const FileRef& file) {
  std::ifstream in(file.path, std::ios::binary);
  char head[12] = {};
  in.read(head, sizeof head);
  const std::string_view h(head, sizeof head);
  if (in.gcount() == 0) throw file_error(ErrorKind::kMalformed, file.name, "expected an image, got an empty file");
  if (h.starts_with("\x89PNG")) return "png";
  if (h.starts_with("\xff\xd8\xff")) return "jpeg";
  if (h.starts_with(std::string_view("II*\0", 4)) || h.starts_with(std::string_view("MM\0*", 4))) return "tiff";
  if (h.starts_with("v/1\x01")) return "openexr";
  if (h.starts_with("BM")) return "bmp";
  if (h.starts_with("#?")) return "hdr";
  if (h.starts_with("\xabKTX 20\xbb") || h.starts_with("DDS "))
    throw file_error(ErrorKind::kUnsupported, file.name,
                     std::string("expected an image, got a ") + (h[0] == 'D' ? "DDS" : "KTX2") +
                         ", which is read as an indexed normal map only");
  if (h[0] == 'P' && ((h[1] >= '1' && h[1] <= '6') || h[1] == 'f' || h[1] == 'F')) return "pnm";
  std::string extension = std::filesystem::path(file.name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".tga") return "targa";
  throw file_error(ErrorKind::kMalformed, file.name,
                   "expected an image (PNG, TIFF, EXR, JPEG, TGA, BMP, HDR or PNM), got something else");
}

// A CheckedFile as OpenImageIO's codecs take it. Most of them look at no result of their own writes: without it a full
// disk passes unseen.
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

}  // namespace

void require_readable(const FileRef& file) {
  struct stat st;
  if (::stat(file.path.c_str(), &st) != 0)
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(st.st_mode)) throw file_error(ErrorKind::kIo, file.name, "expected a file, got a directory");
  if (!std::ifstream(file.path, std::ios::binary))
    throw file_error(ErrorKind::kIo, file.name, std::string("cannot be read: ") + std::strerror(errno));
}

const char* name(SampleType type) {
  switch (type) {
    case SampleType::kUint8:
      return "uint8";
    case SampleType::kUint16:
      return "uint16";
    case SampleType::kHalf:
      return "half";
    default:
      return "float";
  }
}

const char* name(FileType type) { return info_of(type).name; }

FileType file_type_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const FileTypeInfo& t : file_types())
    for (const char* e : t.extensions)
      if (extension == e) return t.type;
  throw file_error(
      ErrorKind::kUnsupported, file,
      "expected an output named .png, .tif, .exr, .tga or .bmp (.ktx2 or .dds for indexed normal maps), got '" +
          extension + "'");
}

SampleType default_sample_type(FileType type) { return info_of(type).default_sample; }

void require_can_hold(FileType type, SampleType sample, const std::string& file) {
  const FileTypeInfo& t = info_of(type);
  if (std::ranges::find(t.samples, sample) != t.samples.end()) return;
  if (t.samples.empty())
    throw file_error(ErrorKind::kUnsupported, file, std::string(t.name) + " is written for indexed normal maps only");
  std::string holds;
  for (SampleType s : t.samples) holds += (holds.empty() ? "" : " or ") + std::string(name(s));
  throw file_error(ErrorKind::kUnsupported, file, std::string(t.name) + " holds " + holds + ", not " + name(sample));
}

struct ImageReader::Impl {
  FileRef file;
  std::unique_ptr<OIIO::ImageInput> in;
  OIIO::ImageSpec spec;
  std::string codec;
  // Of a tiled file, the row of tiles that was read last.
  std::vector<std::byte> tiles;
  int tiles_first = -1;
  OIIO::TypeDesc tiles_type;

  [[noreturn]] void fail() {
    std::string what = one_line(in ? in->geterror() : OIIO::geterror());
    throw file_error(ErrorKind::kMalformed, file.name, what.empty() ? "is damaged or cut short" : what);
  }

  void open() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    in = OIIO::ImageInput::create(codec);
    if (!in) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + codec);
    if (!in->open(file.path, spec, config)) fail();
  }

  void read(int first, int count, OIIO::TypeDesc type, void* out) {
    const std::size_t row_bytes = std::size_t(spec.width) * spec.nchannels * type.size();
    const int y0 = spec.y;
    if (spec.tile_width == 0) {
      // The TIFF codec reports success for strips that the file is too short for, and leaves a message.
      if (!in->read_scanlines(0, 0, y0 + first, y0 + first + count, 0, 0, spec.nchannels, type, out) || in->has_error())
        fail();
      return;
    }
    for (int y = first; y < first + count;) {
      const int tile_first = y / spec.tile_height * spec.tile_height;
      const int tile_end = std::min(tile_first + spec.tile_height, spec.height);
      if (tile_first != tiles_first || tiles_type != type) {
        tiles.resize(row_bytes * spec.tile_height);
        tiles_first = -1;
        if (!in->read_tiles(0, 0, spec.x, spec.x + spec.width, y0 + tile_first, y0 + tile_end, 0, 1, 0, spec.nchannels,
                            type, tiles.data()) ||
            in->has_error())
          fail();
        tiles_first = tile_first;
        tiles_type = type;
      }
      const int end = std::min(first + count, tile_end);
      std::memcpy(static_cast<std::byte*>(out) + row_bytes * (y - first), tiles.data() + row_bytes * (y - tile_first),
                  row_bytes * (end - y));
      y = end;
    }
  }
};

ImageReader::ImageReader(const FileRef& file) : impl_(std::make_unique<Impl>()) {
  impl_->file = file;
  require_readable(file);
  impl_->codec = codec_from_signature(file);
  impl_->open();
  const OIIO::ImageSpec& spec = impl_->spec;
  if (spec.depth > 1 || spec.deep)
    throw file_error(ErrorKind::kUnsupported, file.name, "expected a flat image, got a volume or deep image");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected the data window to be the whole image, got " + std::to_string(spec.width) + "x" +
                         std::to_string(spec.height) + " texels of " + std::to_string(spec.full_width) + "x" +
                         std::to_string(spec.full_height));
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    throw file_error(ErrorKind::kMalformed, file.name, "expected an image with texels, got none");
}

ImageReader::~ImageReader() = default;
ImageReader::ImageReader(ImageReader&&) noexcept = default;

int ImageReader::width() const { return impl_->spec.width; }
int ImageReader::height() const { return impl_->spec.height; }
int ImageReader::channels() const { return impl_->spec.nchannels; }
bool ImageReader::integer() const { return !impl_->spec.format.is_floating_point(); }

SampleType ImageReader::sample_type() const {
  switch (impl_->spec.format.basetype) {
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

bool ImageReader::has_exact_samples() const {
  return impl_->spec.format == to_oiio(sample_type()) && impl_->spec.channelformats.empty();
}
const std::vector<std::string>& ImageReader::channel_names() const { return impl_->spec.channelnames; }
const std::string& ImageReader::name() const { return impl_->file.name; }
std::size_t ImageReader::file_bytes() const { return impl_->spec.image_bytes(true); }

void ImageReader::read_rows(int first, int count, float* out) { impl_->read(first, count, OIIO::TypeDesc::FLOAT, out); }

void ImageReader::read_rows_stored(int first, int count, void* out) {
  impl_->read(first, count, impl_->spec.format, out);
}

void ImageReader::require_size(int w, int h, const std::string& what) const {
  if (width() == w && height() == h) return;
  throw file_error(ErrorKind::kMalformed, name(),
                   "expected " + std::to_string(w) + "x" + std::to_string(h) + " texels as in " + what + ", got " +
                       std::to_string(width()) + "x" + std::to_string(height()));
}

struct ImageWriter::Impl {
  FileRef file;
  std::unique_ptr<CheckedProxy> to;  // outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> out;
  OIIO::ImageSpec spec;
  SampleType sample;
  int next = 0;
  std::vector<std::byte> converted;

  [[noreturn]] void fail() { throw to->file.error(file.name, out ? one_line(out->geterror()) : ""); }

  void write(int count, const void* rows, OIIO::TypeDesc type) {
    if (!out->write_scanlines(next, next + count, 0, type, rows) || to->file.first_error()) fail();
    next += count;
  }
};

ImageWriter::ImageWriter(const FileRef& file, FileType type, SampleType sample, int width, int height, int channels,
                         const Attributes& attributes)
    : impl_(std::make_unique<Impl>()) {
  require_can_hold(type, sample, file.name);
  impl_->file = file;
  impl_->sample = sample;
  impl_->out = OIIO::ImageOutput::create(info_of(type).codec);
  if (!impl_->out) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + std::string(name(type)));
  OIIO::ImageSpec& spec = impl_->spec;
  spec = OIIO::ImageSpec(width, height, channels, to_oiio(sample));
  if (channels == 1) spec.channelnames = {"Y"};
  if (type == FileType::kPng) spec.attribute("png:compressionLevel", 6);
  if (type == FileType::kTiff) spec.attribute("compression", "zip");
  if (type == FileType::kExr) spec.attribute("compression", "zip");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("DateTime", "");  // or the codec puts the clock into the file
  for (const auto& [key, value] : attributes) spec.attribute(key, value);
  impl_->to = std::make_unique<CheckedProxy>(file.path);
  if (impl_->to->file.first_error()) impl_->fail();
  OIIO::Filesystem::IOProxy* to = impl_->to.get();
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &to);
  if (!impl_->out->open(file.path, spec)) impl_->fail();
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write_rows(int count, const float* rows) {
  const std::size_t samples = std::size_t(count) * impl_->spec.width * impl_->spec.nchannels;
  if (impl_->sample != SampleType::kUint8 && impl_->sample != SampleType::kUint16) {
    impl_->write(count, rows, OIIO::TypeDesc::FLOAT);
    return;
  }
  impl_->converted.resize(samples * sample_bytes(impl_->sample));
  const auto round = [&](auto* to, float max) {
    for (std::size_t i = 0; i < samples; i++) {
      const float v = std::min(std::max(rows[i], 0.f), 1.f);
      to[i] = static_cast<std::remove_reference_t<decltype(*to)>>(v * max + 0.5f);
    }
  };
  if (impl_->sample == SampleType::kUint8) round(reinterpret_cast<std::uint8_t*>(impl_->converted.data()), 255.f);
  else round(reinterpret_cast<std::uint16_t*>(impl_->converted.data()), 65535.f);
  write_rows_stored(count, impl_->converted.data());
}

void ImageWriter::write_rows_stored(int count, const void* rows) { impl_->write(count, rows, impl_->spec.format); }

void ImageWriter::close() {
  if (!impl_->out->close()) impl_->fail();
  impl_->out.reset();  // some files are complete only now
  impl_->to->file.close();
  if (impl_->to->file.first_error()) impl_->fail();
}

Image read_image(const FileRef& file) {
  ImageReader reader(file);
  Image image(reader.width(), reader.height(), reader.channels());
  reader.read_rows(0, image.height, image.data.data());
  return image;
}

void write_image(const FileRef& file, FileType type, SampleType sample, const Image& image,
                 const ImageWriter::Attributes& attributes) {
  ImageWriter writer(file, type, sample, image.width, image.height, image.channels, attributes);
  writer.write_rows(image.height, image.data.data());
  writer.close();
}

ByteImage read_ids(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  if (reader.channels() != 1)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected 1 channel of material ids, got " + std::to_string(reader.channels()));
  if (!reader.has_exact_samples() || reader.sample_type() != SampleType::kUint8)
    throw file_error(ErrorKind::kMalformed, file.name,
                     std::string("expected material ids as uint8, got ") + burnish::name(reader.sample_type()));
  reader.require_size(width, height, "the normal map");
  ByteImage ids(width, height);
  reader.read_rows_stored(0, height, ids.data.data());
  return ids;
}

ByteImage read_mask(const FileRef& file, int width, int height) {
  ImageReader reader(file);
  reader.require_size(width, height, "the map it masks");
  ByteImage mask(width, height);
  std::vector<float> row(std::size_t(width) * reader.channels());
  for (int y = 0; y < height; y++) {
    reader.read_rows(y, 1, row.data());
    for (int x = 0; x < width; x++) mask.row(y)[x] = row[std::size_t(x) * reader.channels()] != 0.f;
  }
  return mask;
}

void set_codec_threads(int threads) {
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads == 0 ? 0 : threads == 1 ? -1 : threads);
}

std::string codec_version() {
  return "OpenImageIO " + std::to_string(OIIO_VERSION_MAJOR) + "." + std::to_string(OIIO_VERSION_MINOR) + "." +
         std::to_string(OIIO_VERSION_PATCH);
}

}  // namespace burnish
