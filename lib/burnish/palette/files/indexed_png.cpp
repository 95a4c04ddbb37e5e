// Indexed maps in PNG, through libpng: OpenImageIO neither reads nor writes palettes.
#include <png.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

constexpr const char* kKeyword = "burnish";

struct Closer {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, Closer>;

// libpng reports by a call that must not return; an exception passes through its C frames on this platform, and its
// structs are released by the destructors of Reader and Writer.
struct PngFailure {
  std::string message;
};
[[noreturn]] void on_error(png_structp, png_const_charp message) { throw PngFailure{message}; }
void on_warning(png_structp, png_const_charp) {}

std::string metadata(const Palette& palette) {
  std::string json = "{\"format\":1,\"space\":\"" + std::string(name(palette.space)) +
                     "\",\"y\":\"up\",\"materials\":" + materials_to_json(palette.materials) + ",\"palette\":[";
  char number[32];
  for (std::size_t i = 0; i < palette.normals.size(); i++)
    for (float v : {palette.normals[i].x, palette.normals[i].y, palette.normals[i].z}) {
      const auto end =
          std::to_chars(number, number + sizeof number, v, std::chars_format::general, 9);  // 9 digits: exact
      if (json.back() != '[') json += ',';
      json.append(number, end.ptr);
    }
  return json + "]}";
}

Palette palette_from_metadata(const std::string& text, const FileRef& file) {
  Palette palette;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (const int format = json.value("format", 1); format != 1)
      throw file_error(ErrorKind::kUnsupported, file.name, "expected format 1, got " + std::to_string(format));
    palette.space = space_from_name(json.value("space", "tangent"), file.name);
    require_y_up(json.value("y", "up"), file.name);
    const std::vector<double> flat = json.at("palette").get<std::vector<double>>();
    if (flat.size() % 3 != 0)
      throw file_error(ErrorKind::kMalformed, file.name, "expected three numbers a palette entry");
    for (std::size_t i = 0; i < flat.size(); i += 3)
      palette.normals.push_back({float(flat[i]), float(flat[i + 1]), float(flat[i + 2])});
    palette.materials = materials_from_json(json.at("materials").dump(), file.name);
  } catch (const nlohmann::json::exception&) {
    throw file_error(ErrorKind::kMalformed, file.name, "expected palette and materials in the text chunk 'burnish'");
  }
  validate(palette, file.name);
  return palette;
}

struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  File stream;

  Reader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)) {
    info = png_create_info_struct(png);
  }
  explicit Reader(const FileRef& file) : Reader() {  // delegating, so that the destructor runs whatever this throws
    stream.reset(std::fopen(file.path.c_str(), "rb"));
    if (!stream) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
    png_init_io(png, stream.get());
    png_read_info(png, info);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  std::optional<std::string> text() const {
    png_textp entries;
    int count = 0;
    png_get_text(png, info, &entries, &count);
    for (int i = 0; i < count; i++)
      if (std::string(entries[i].key) == kKeyword) return entries[i].text ? entries[i].text : "";
    return std::nullopt;
  }
  bool has_palette() const { return png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE; }
  bool is_indexed() const {
    return has_palette() || (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && text().has_value());
  }
};

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  CheckedFile file;
  std::string name;

  explicit Writer(const FileRef& to)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)),
        file(to.path),
        name(to.name) {
    info = png_create_info_struct(png);
    png_set_write_fn(
        png, this,
        [](png_structp p, png_bytep bytes, std::size_t size) {
          Writer& writer = *static_cast<Writer*>(png_get_io_ptr(p));
          if (writer.file.write(bytes, size) != size) throw writer.file.error(writer.name);
        },
        nullptr);
    png_set_compression_level(png, 6);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }

  void header(int width, int height, int depth, int color_type, const Palette& palette) {
    png_set_IHDR(png, info, width, height, depth, color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::string json = metadata(palette);
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_zTXt;
    text.key = const_cast<char*>(kKeyword);
    text.text = json.data();
    text.lang = text.lang_key = const_cast<char*>("");
    png_set_text(png, info, &text, 1);
  }
  void finish() {
    png_write_end(png, info);
    file.close();
    if (file.first_error()) throw file.error(name);
  }
};

png_byte to_byte(float v) { return png_byte((0.5f * v + 0.5f) * 255.f + 0.5f); }

// Runs what calls libpng, and says in whose file it failed.
template <typename Body>
auto guarded(const FileRef& file, ErrorKind kind, const Body& body) {
  try {
    return body();
  } catch (const PngFailure& failure) {
    throw file_error(kind, file.name, (kind == ErrorKind::kIo ? "cannot be written: " : "") + failure.message);
  }
}

Palette palette_of(const Reader& in, const FileRef& file, GreenAxis green) {
  if (const std::optional<std::string> text = in.text()) return palette_from_metadata(*text, file);
  Palette palette;
  png_colorp colours;
  int count = 0;
  png_get_PLTE(in.png, in.info, &colours, &count);
  const float y_sign = green == GreenAxis::kDown ? -1.f : 1.f;
  for (int i = 0; i < count; i++) {
    const Vec3d v{colours[i].red / 127.5 - 1, y_sign * (colours[i].green / 127.5 - 1), colours[i].blue / 127.5 - 1};
    palette.normals.push_back(length(v) < 1e-3 ? Vec3f{0, 0, 1} : Vec3f(normalized(v)));
  }
  palette.materials = {{0, 0, count}};
  return palette;
}

class PngSource final : public IndexSource {
 public:
  PngSource(const FileRef& file, GreenAxis green) : file_(file) {
    open();
    palette = palette_of(*in_, file, green);
    width = int(png_get_image_width(in_->png, in_->info)), height = int(png_get_image_height(in_->png, in_->info));
  }

  void read_rows(int, int first, int count, std::uint16_t* out) override {
    guarded(file_, ErrorKind::kMalformed, [&] {
      if (interlaced_) return copy_rows(whole(), first, count, out);
      if (first < next_row_) open();
      std::vector<png_byte> row(row_bytes_);
      for (; next_row_ < first + count; next_row_++) {
        png_read_row(in_->png, row.data(), nullptr);
        if (next_row_ >= first) widen(row.data(), out), out += width;
      }
      if (next_row_ == height) png_read_end(in_->png, nullptr);  // what follows is checked too
    });
  }

 private:
  void open() {
    in_.emplace(file_);
    depth_ = png_get_bit_depth(in_->png, in_->info);
    require_room_for(file_, png_get_image_width(in_->png, in_->info), png_get_image_height(in_->png, in_->info),
                     depth_);
    png_set_packing(in_->png);
    if (depth_ == 16) png_set_swap(in_->png);
    interlaced_ = png_set_interlace_handling(in_->png) > 1;
    png_read_update_info(in_->png, in_->info);
    row_bytes_ = png_get_rowbytes(in_->png, in_->info);
    next_row_ = 0;
  }

  void widen(const png_byte* row, std::uint16_t* out) const {
    if (depth_ == 16) std::memcpy(out, row, row_bytes_);
    else std::copy_n(row, width, out);
  }

  // The rows of an interlaced image come all at once.
  const std::vector<png_byte>& whole() {
    if (whole_.empty()) {
      whole_.resize(row_bytes_ * height);
      std::vector<png_bytep> rows(height);
      for (int y = 0; y < height; y++) rows[y] = whole_.data() + row_bytes_ * y;
      png_read_image(in_->png, rows.data());
      png_read_end(in_->png, nullptr);
    }
    return whole_;
  }
  void copy_rows(const std::vector<png_byte>& from, int first, int count, std::uint16_t* out) const {
    for (int y = first; y < first + count; y++, out += width) widen(from.data() + row_bytes_ * y, out);
  }

  FileRef file_;
  std::optional<Reader> in_;
  int depth_ = 0, next_row_ = 0;
  bool interlaced_ = false;
  std::size_t row_bytes_ = 0;
  std::vector<png_byte> whole_;
};

class PngTarget final : public IndexTarget {
 public:
  PngTarget(const FileRef& file, const IndexShape& shape)
      : file_(file), out_(file), width_(shape.width), small_(shape.palette.normals.size() <= 256) {
    out_.header(width_, shape.height, small_ ? 8 : 16, small_ ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY,
                shape.palette);
    if (small_) {
      std::vector<png_color> colours;
      for (const Vec3f& n : shape.palette.normals) colours.push_back({to_byte(n.x), to_byte(n.y), to_byte(n.z)});
      png_set_PLTE(out_.png, out_.info, colours.data(), int(colours.size()));
    }
    png_write_info(out_.png, out_.info);
    if (!small_) png_set_swap(out_.png);
  }

  void write_rows(int, int count, const std::uint16_t* rows) override {
    guarded(file_, ErrorKind::kIo, [&] {
      std::vector<png_byte> bytes(width_);
      for (int y = 0; y < count; y++, rows += width_) {
        if (small_) std::copy_n(rows, width_, bytes.begin());
        png_write_row(out_.png, small_ ? bytes.data() : reinterpret_cast<const png_byte*>(rows));
      }
    });
  }

  void close() override {
    guarded(file_, ErrorKind::kIo, [&] { out_.finish(); });
  }

 private:
  FileRef file_;
  Writer out_;
  int width_;
  bool small_;
};

}  // namespace

bool is_indexed_png(const FileRef& file) {
  try {
    return Reader(file).is_indexed();
  } catch (const PngFailure&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_png(const FileRef& file, GreenAxis green) {
  return guarded(file, ErrorKind::kMalformed, [&] { return std::make_unique<PngSource>(file, green); });
}

std::unique_ptr<IndexTarget> create_indexed_png(const FileRef& file, const IndexShape& shape) {
  return guarded(file, ErrorKind::kIo, [&] { return std::make_unique<PngTarget>(file, shape); });
}

std::optional<Palette> read_palette_png(const FileRef& file) {
  return guarded(file, ErrorKind::kMalformed, [&]() -> std::optional<Palette> {
    const std::optional<std::string> text = Reader(file).text();
    return text ? std::optional(palette_from_metadata(*text, file)) : std::nullopt;
  });
}

void write_palette_png(const FileRef& file, const Palette& palette) {
  guarded(file, ErrorKind::kIo, [&] {
    Writer out(file);
    out.header(int(palette.normals.size()), 1, 8, PNG_COLOR_TYPE_RGB, palette);
    png_write_info(out.png, out.info);
    std::vector<png_byte> row;
    for (const Vec3f& n : palette.normals) row.insert(row.end(), {to_byte(n.x), to_byte(n.y), to_byte(n.z)});
    png_write_row(out.png, row.data());
    out.finish();
  });
}

}  // namespace burnish::detail
