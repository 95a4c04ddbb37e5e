#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "burnish/core/attribute_codec.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/sound_header.h"
#include "burnish/core/texel_limit.h"
#include "burnish/core/whole_image.h"

namespace burnish {

using detail::to_oiio;

namespace {

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
  for (const char* tiff : {"II*\0", "MM\0*", "II+\0", "MM\0+"})  // the latter two beyond 4 GB
    if (h.starts_with(std::string_view(tiff, 4))) return "tiff";
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

// Texels that a byte of a file holds at most; none where the codec knows no bound.
std::optional<std::size_t> most_texels_in_byte(const std::string& codec) {
  constexpr std::size_t kBits = 8, kDeflate = 1032, kRunLengths = 128, kJpegBlock = 32 * 32;
  if (codec == "png") return kBits * kDeflate;
  if (codec == "jpeg") return kBits * kJpegBlock;
  if (codec == "targa") return kRunLengths;
  if (codec == "pnm") return kBits;
  return std::nullopt;
}

}  // namespace

struct ImageReader::Impl {
  FileRef file;
  std::unique_ptr<OIIO::ImageInput> in;
  OIIO::ImageSpec spec;
  std::string codec;
  // Of a tiled file, the row of tiles that was read last, as stored: so it takes the least room.
  std::vector<std::byte> tiles;
  int tiles_first = -1;
  OIIO::TypeDesc tiles_type;  // float where channels are of several types

  [[noreturn]] void fail() {
    const std::string what = codec_message(in ? in->geterror() : OIIO::geterror(), file);
    throw file_error(ErrorKind::kMalformed, file.name, what.empty() ? "is damaged or cut short" : what);
  }

  void open() {
    require_sound_header(file);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    in = OIIO::ImageInput::create(codec);
    if (!in) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + codec);
    if (!in->open(file.path, spec, config)) fail();
  }

  // Before anyone sets memory aside for what a header claims.
  void require_room() const {
    const std::optional<std::size_t> most = most_texels_in_byte(codec);
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file.path, unknown);
    if (most && !unknown && spec.image_pixels() / *most > bytes)
      throw file_error(
          ErrorKind::kMalformed, file.name,
          "is too short for " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " texels");
    // Tiles are decoded whole, however much larger than the image they say they are; few texels are too few to matter.
    constexpr std::size_t kMostInTile = 8 * 1032, kFew = 1 << 16;
    if (!unknown && spec.tile_pixels() > kFew && spec.tile_pixels() / kMostInTile > bytes)
      throw file_error(ErrorKind::kMalformed, file.name,
                       "is too short for tiles of " + std::to_string(spec.tile_width) + "x" +
                           std::to_string(spec.tile_height) + " texels");
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
    const std::size_t row_samples = std::size_t(spec.width) * spec.nchannels;
    for (int y = first; y < first + count;) {
      const int tile_first = y / spec.tile_height * spec.tile_height;
      if (tile_first != tiles_first) read_tiles(tile_first);
      const int end = std::min({first + count, tile_first + spec.tile_height, spec.height});
      const std::byte* from = tiles.data() + row_samples * tiles_type.size() * (y - tile_first);
      std::byte* to = static_cast<std::byte*>(out) + row_bytes * (y - first);
      if (type == tiles_type) std::memcpy(to, from, row_bytes * (end - y));
      else OIIO::convert_pixel_values(tiles_type, from, type, to, int(row_samples * (end - y)));
      y = end;
    }
  }

  void read_tiles(int first) {
    const int end = std::min(first + spec.tile_height, spec.height);
    tiles_type = spec.channelformats.empty() ? spec.format : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
    tiles.resize(std::size_t(spec.width) * spec.nchannels * tiles_type.size() * spec.tile_height);
    tiles_first = -1;
    if (!in->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + first, spec.y + end, 0, 1, 0, spec.nchannels,
                        tiles_type, tiles.data()) ||
        in->has_error())
      fail();
    tiles_first = first;
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
  impl_->require_room();
  require_within_texel_limit(file.name, std::uint32_t(spec.width), std::uint32_t(spec.height));
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
std::optional<std::string> ImageReader::text(const std::string& attribute) const {
  return detail::text_attribute(impl_->spec, attribute);
}
std::optional<std::vector<double>> ImageReader::numbers(const std::string& attribute) const {
  return detail::number_attribute(impl_->spec, attribute);
}
std::size_t ImageReader::file_bytes() const { return impl_->spec.image_bytes(true); }

void ImageReader::read_rows(int first, int count, float* out) { impl_->read(first, count, OIIO::TypeDesc::FLOAT, out); }

void ImageReader::read_rows_stored(int first, int count, void* out) {
  impl_->read(first, count, impl_->spec.format, out);
}

int ImageReader::levels() const {
  int n = 1;
  while (impl_->in->seek_subimage(0, n)) n++;  // of TIFF, spec() gives one for any number
  impl_->in->geterror();                       // that there is no further one is no failure
  return n;
}

Image ImageReader::read_level(int level) {
  if (level == 0) {
    Image image;
    image.width = width(), image.height = height(), image.channels = channels();
    image.data = read_whole<float>(name(), image.height, std::size_t(image.width) * image.channels,
                                   [&](int first, int count, float* out) { read_rows(first, count, out); });
    return image;
  }
  const OIIO::ImageSpec spec = impl_->in->spec_dimensions(0, level);
  Image image(spec.width, spec.height, channels());
  if (spec.nchannels != channels() ||
      !impl_->in->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.data.data()) ||
      impl_->in->has_error())
    impl_->fail();
  return image;
}

void ImageReader::require_size(int w, int h, const std::string& what) const {
  if (width() == w && height() == h) return;
  throw file_error(ErrorKind::kMalformed, name(),
                   "expected " + std::to_string(w) + "x" + std::to_string(h) + " texels as in " + what + ", got " +
                       std::to_string(width()) + "x" + std::to_string(height()));
}

}  // namespace burnish
