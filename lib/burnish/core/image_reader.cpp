#include <filesystem>
#include <fstream>
#include <optional>

#include "burnish/core/attribute_text.h"
#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/lower_case.h"
#include "burnish/core/sound_header.h"
#include "burnish/core/texel_limit.h"
#include "burnish/core/whole_image.h"

namespace burnish {

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
  if (lower_case_extension(file.name) == ".tga") return "targa";
  throw file_error(ErrorKind::kMalformed, file.name,
                   "expected an image (PNG, TIFF, EXR, JPEG, TGA, BMP, HDR or PNM), got something else");
}

// Texels that a byte of a file holds at most; none where the codec knows no bound.
std::optional<std::size_t> most_texels_in_byte(const std::string& codec) {
  constexpr std::size_t kBits = 8, kRunLengths = 128, kJpegBlock = 32 * 32;
  if (codec == "jpeg") return kBits * kJpegBlock;
  if (codec == "targa") return kRunLengths;
  if (codec == "pnm") return kBits;
  return std::nullopt;
}

}  // namespace

struct ImageReader::Impl {
  FileRef file;
  std::unique_ptr<detail::ImageSource> in;

  const detail::ImageForm& form() const { return in->form(); }

  // Before anyone sets memory aside for what a header claims.
  void require_room(const std::string& codec) const {
    const std::optional<std::size_t> most = most_texels_in_byte(codec);
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file.path, unknown);
    if (most && !unknown && std::uintmax_t(form().width) * form().height / *most > bytes)
      throw file_error(
          ErrorKind::kMalformed, file.name,
          "is too short for " + std::to_string(form().width) + "x" + std::to_string(form().height) + " texels");
  }
};

ImageReader::ImageReader(const FileRef& file) : impl_(std::make_unique<Impl>()) {
  impl_->file = file;
  require_readable(file);
  const std::string codec = codec_from_signature(file);
  require_sound_header(file);
  impl_->in = codec == "png"       ? detail::open_png_image(file)
              : codec == "openexr" ? detail::open_exr_image(file)
                                   : detail::open_other_image(file, codec);
  if (width() <= 0 || height() <= 0 || channels() <= 0)
    throw file_error(ErrorKind::kMalformed, file.name, "expected an image with texels, got none");
  impl_->require_room(codec);
  require_within_texel_limit(file.name, std::uint32_t(width()), std::uint32_t(height()));
}

ImageReader::~ImageReader() = default;
ImageReader::ImageReader(ImageReader&&) noexcept = default;

int ImageReader::width() const { return impl_->form().width; }
int ImageReader::height() const { return impl_->form().height; }
int ImageReader::channels() const { return impl_->form().channels(); }
bool ImageReader::integer() const { return impl_->form().integer; }
SampleType ImageReader::sample_type() const { return impl_->form().sample; }
bool ImageReader::has_exact_samples() const { return impl_->form().exact; }
const std::vector<std::string>& ImageReader::channel_names() const { return impl_->form().channel_names; }
const std::string& ImageReader::name() const { return impl_->file.name; }
std::optional<std::string> ImageReader::text(const std::string& attribute) const {
  return detail::text_attribute(impl_->form().attributes, attribute);
}
std::optional<std::vector<double>> ImageReader::numbers(const std::string& attribute) const {
  return detail::number_attribute(impl_->form().attributes, attribute);
}
std::size_t ImageReader::file_bytes() const {
  return impl_->form().texel_bytes * std::size_t(width()) * std::size_t(height());
}

void ImageReader::read_rows(int first, int count, float* out) { impl_->in->read_rows(first, count, out); }
void ImageReader::read_rows_stored(int first, int count, void* out) { impl_->in->read_rows_stored(first, count, out); }

int ImageReader::levels() const { return impl_->in->levels(); }

Image ImageReader::read_level(int level) {
  if (level == 0) {
    Image image;
    image.width = width(), image.height = height(), image.channels = channels();
    image.data = read_whole<float>(name(), image.height, std::size_t(image.width) * image.channels,
                                   [&](int first, int count, float* out) { read_rows(first, count, out); });
    return image;
  }
  const auto [width, height] = impl_->in->level_size(level);
  Image image(width, height, channels());
  impl_->in->read_level(level, image.data.data());
  return image;
}

void ImageReader::require_size(int w, int h, const std::string& what) const {
  if (width() == w && height() == h) return;
  throw file_error(ErrorKind::kMalformed, name(),
                   "expected " + std::to_string(w) + "x" + std::to_string(h) + " texels as in " + what + ", got " +
                       std::to_string(width()) + "x" + std::to_string(height()));
}

}  // namespace burnish
