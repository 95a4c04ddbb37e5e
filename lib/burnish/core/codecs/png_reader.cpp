#include <png.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "burnish/core/codecs/png_call.h"
#include "burnish/core/codecs/png_file.h"

namespace burnish::detail {
namespace {

struct Closer {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

// libpng's structs of a file whose header has been read.
class OpenPng {
 public:
  explicit OpenPng(const FileRef& file) : stream_(std::fopen(file.path.c_str(), "rb")) {
    if (!stream_) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_png_error, on_png_warning);
    info = png_create_info_struct(png);
  }
  ~OpenPng() { png_destroy_read_struct(&png, &info, nullptr); }
  OpenPng(const OpenPng&) = delete;
  OpenPng& operator=(const OpenPng&) = delete;

  void read_header() {
    png_set_read_fn(png, stream_.get(), [](png_structp p, png_bytep bytes, std::size_t size) {
      if (std::fread(bytes, 1, size, static_cast<std::FILE*>(png_get_io_ptr(p))) != size)
        png_error(p, "Read error: hit end of file");
    });
    png_read_info(png, info);
  }
  int stored_bits() const { return png_get_bit_depth(png, info) * png_get_channels(png, info); }  // of a texel

  png_structp png = nullptr;
  png_infop info = nullptr;

 private:
  std::unique_ptr<std::FILE, Closer> stream_;
};

// A few bytes must not make us ask for gigabytes.
void require_room(const FileRef& file, const OpenPng& in) {
  constexpr std::uint64_t kMostExpansion = 1032;  // of deflate
  const std::uint64_t width = png_get_image_width(in.png, in.info), height = png_get_image_height(in.png, in.info);
  std::error_code unknown;
  const std::uint64_t bytes = std::filesystem::file_size(file.path, unknown);
  if (!unknown && width * height / 8 * in.stored_bits() > kMostExpansion * bytes)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "is too short for " + std::to_string(width) + "x" + std::to_string(height) + " texels");
}

std::vector<PngText> texts_of(const OpenPng& in) {
  png_textp entries = nullptr;
  int count = 0;
  png_get_text(in.png, in.info, &entries, &count);
  std::vector<PngText> texts;
  for (int i = 0; i < count; i++) texts.push_back({entries[i].key, entries[i].text ? entries[i].text : ""});
  return texts;
}

std::vector<PngColour> palette_of(const OpenPng& in) {
  png_colorp colours = nullptr;
  int count = 0;
  png_get_PLTE(in.png, in.info, &colours, &count);
  std::vector<PngColour> palette;
  for (int i = 0; i < count; i++) palette.push_back({colours[i].red, colours[i].green, colours[i].blue});
  return palette;
}

}  // namespace

struct PngReader::Impl {
  FileRef file;
  PngSamples samples;
  std::optional<OpenPng> in;
  PngForm form;
  bool interlaced = false;
  std::size_t row_bytes = 0;
  int next = 0;                 // row that libpng gives next
  std::vector<png_byte> spare;  // a row that nobody wants
  std::vector<png_byte> whole;  // of an interlaced file

  // From the first byte on, with the transformations of `samples`.
  void open() {
    in.emplace(file);
    in->read_header();
    require_room(file, *in);
    PngForm now;
    if (samples == PngSamples::kColours) {
      png_set_expand(in->png);
    } else {
      png_set_packing(in->png);
      if (png_get_color_type(in->png, in->info) == PNG_COLOR_TYPE_PALETTE) now.palette = palette_of(*in);
    }
    if constexpr (std::endian::native == std::endian::little) png_set_swap(in->png);
    interlaced = png_set_interlace_handling(in->png) > 1;
    png_read_update_info(in->png, in->info);
    row_bytes = png_get_rowbytes(in->png, in->info);
    now.width = int(png_get_image_width(in->png, in->info));
    now.height = int(png_get_image_height(in->png, in->info));
    now.channels = png_get_channels(in->png, in->info);
    now.bits = png_get_bit_depth(in->png, in->info);
    if (form.width > 0 && std::tie(now.width, now.height, now.channels, now.bits) !=
                              std::tie(form.width, form.height, form.channels, form.bits))
      throw file_error(ErrorKind::kIo, file.name, "has changed while it was read");
    now.texts = texts_of(*in);
    form = std::move(now);
    next = 0;
  }

  void read_next(png_bytep row) {
    png_read_row(in->png, row, nullptr);
    if (++next == form.height) png_read_end(in->png, nullptr);  // what follows is checked too
  }

  void read_whole() {
    std::vector<png_byte> texels(row_bytes * form.height);
    std::vector<png_bytep> rows(form.height);
    for (int y = 0; y < form.height; y++) rows[y] = texels.data() + row_bytes * y;
    png_read_image(in->png, rows.data());
    png_read_end(in->png, nullptr);
    whole = std::move(texels);
  }

  void read(int first, int count, png_bytep out) {
    if (!in || (first < next && !interlaced)) open();
    if (interlaced) {
      if (whole.empty()) read_whole();
      std::memcpy(out, whole.data() + row_bytes * first, row_bytes * count);
      return;
    }
    spare.resize(row_bytes);
    while (next < first) read_next(spare.data());
    for (int y = 0; y < count; y++, out += row_bytes) read_next(out);
  }
};

PngReader::PngReader(const FileRef& file, PngSamples samples)
    : impl_(new Impl{file, samples, {}, {}, false, 0, 0, {}, {}}) {
  calling_png(file, ErrorKind::kMalformed, [&] { impl_->open(); });
}
PngReader::~PngReader() = default;

const PngForm& PngReader::form() const { return impl_->form; }

void PngReader::read_rows(int first, int count, void* out) {
  calling_png(impl_->file, ErrorKind::kMalformed, [&] {
    try {
      impl_->read(first, count, static_cast<png_bytep>(out));
    } catch (...) {
      impl_->in.reset();  // libpng is not to be asked again
      throw;
    }
  });
}

}  // namespace burnish::detail
