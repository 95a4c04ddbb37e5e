#include <png.h>
#include <zlib.h>

#include <bit>

#include "burnish/core/checked_file.h"
#include "burnish/core/codecs/png_call.h"
#include "burnish/core/codecs/png_file.h"

namespace burnish::detail {
namespace {

int colour_type(const PngForm& form) {
  if (!form.palette.empty()) return PNG_COLOR_TYPE_PALETTE;
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGB_ALPHA};
  return kTypes[form.channels - 1];
}

}  // namespace

struct PngWriter::Impl {
  FileRef file;
  CheckedFile out;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::size_t row_bytes = 0;

  explicit Impl(const FileRef& to) : file(to), out(to.path) {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_png_error, on_png_warning);
    info = png_create_info_struct(png);
    png_set_write_fn(
        png, this,
        [](png_structp p, png_bytep bytes, std::size_t size) {
          Impl& writer = *static_cast<Impl*>(png_get_io_ptr(p));
          if (writer.out.write(bytes, size) != size) throw writer.out.error(writer.file.name);
        },
        nullptr);
  }
  ~Impl() { png_destroy_write_struct(&png, &info); }

  void write_header(const PngForm& form) {
    png_set_IHDR(png, info, form.width, form.height, form.bits, colour_type(form), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    // Of normals, 4 takes a third of the time of 6, for 3 % more bytes; of indices 5 two thirds, for 4 %.
    png_set_compression_level(png, form.channels == 1 ? 5 : 4);
    png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);
    std::vector<png_color> palette;
    for (const PngColour& c : form.palette) palette.push_back({c[0], c[1], c[2]});
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), int(palette.size()));
    for (const PngText& text : form.texts) put(text);
    png_write_info(png, info);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
    row_bytes = png_get_rowbytes(png, info);
  }

  void put(const PngText& from) {
    png_text text{};
    text.compression = from.compressed ? PNG_ITXT_COMPRESSION_zTXt : PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(from.key.c_str());
    text.text = const_cast<char*>(from.text.c_str());
    text.lang = text.lang_key = const_cast<char*>("");
    png_set_text(png, info, &text, 1);
  }
};

PngWriter::PngWriter(const FileRef& file, const PngForm& form) : impl_(std::make_unique<Impl>(file)) {
  calling_png(file, ErrorKind::kIo, [&] { impl_->write_header(form); });
}
PngWriter::~PngWriter() = default;

void PngWriter::write_rows(int count, const void* rows) {
  calling_png(impl_->file, ErrorKind::kIo, [&] {
    const png_byte* row = static_cast<const png_byte*>(rows);
    for (int y = 0; y < count; y++, row += impl_->row_bytes) png_write_row(impl_->png, row);
  });
}

void PngWriter::close() {
  calling_png(impl_->file, ErrorKind::kIo, [&] { png_write_end(impl_->png, impl_->info); });
  impl_->out.close();
  if (impl_->out.first_error()) throw impl_->out.error(impl_->file.name);
}

}  // namespace burnish::detail
