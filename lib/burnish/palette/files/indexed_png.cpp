// Indexed maps in PNG, through libpng: OpenImageIO neither reads nor writes palettes.
#include <png.h>

#include <charconv>
#include <cstdio>
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

}  // namespace

bool is_indexed_png(const FileRef& file) {
  try {
    return Reader(file).is_indexed();
  } catch (const PngFailure&) {
    return false;  // whoever reads it says what is wrong
  }
}

IndexedMap read_indexed_png(const FileRef& file, GreenAxis green) {
  return guarded(file, ErrorKind::kMalformed, [&] {
    Reader in(file);
    IndexedMap map;
    const std::optional<std::string> text = in.text();
    if (text) {
      map.palette = palette_from_metadata(*text, file);
    } else {
      png_colorp colours;
      int count = 0;
      png_get_PLTE(in.png, in.info, &colours, &count);
      const float y_sign = green == GreenAxis::kDown ? -1.f : 1.f;
      for (int i = 0; i < count; i++) {
        const Vec3d v{colours[i].red / 127.5 - 1, y_sign * (colours[i].green / 127.5 - 1), colours[i].blue / 127.5 - 1};
        map.palette.normals.push_back(length(v) < 1e-3 ? Vec3f{0, 0, 1} : Vec3f(normalized(v)));
      }
      map.palette.materials = {{0, 0, count}};
    }
    const int depth = png_get_bit_depth(in.png, in.info);
    require_room_for(file, png_get_image_width(in.png, in.info), png_get_image_height(in.png, in.info), depth);
    png_set_packing(in.png);
    if (depth == 16) png_set_swap(in.png);
    png_set_interlace_handling(in.png);
    png_read_update_info(in.png, in.info);
    map.levels.emplace_back(int(png_get_image_width(in.png, in.info)), int(png_get_image_height(in.png, in.info)));
    IndexImage& level = map.levels[0];
    const std::size_t row_bytes = png_get_rowbytes(in.png, in.info);
    std::vector<png_byte> bytes(row_bytes * level.height);
    std::vector<png_bytep> rows(level.height);
    for (int y = 0; y < level.height; y++) rows[y] = bytes.data() + row_bytes * y;
    png_read_image(in.png, rows.data());
    png_read_end(in.png, nullptr);
    for (int y = 0; y < level.height; y++)
      for (int x = 0; x < level.width; x++)
        level.row(y)[x] = depth == 16 ? reinterpret_cast<const std::uint16_t*>(rows[y])[x] : rows[y][x];
    return map;
  });
}

void write_indexed_png(const FileRef& file, const IndexedMap& map) {
  guarded(file, ErrorKind::kIo, [&] {
    const std::vector<Vec3f>& normals = map.palette.normals;
    const bool small = normals.size() <= 256;
    Writer out(file);
    out.header(map.width(), map.height(), small ? 8 : 16, small ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY,
               map.palette);
    if (small) {
      std::vector<png_color> colours;
      for (const Vec3f& n : normals) colours.push_back({to_byte(n.x), to_byte(n.y), to_byte(n.z)});
      png_set_PLTE(out.png, out.info, colours.data(), int(colours.size()));
    }
    png_write_info(out.png, out.info);
    if (!small) png_set_swap(out.png);
    std::vector<png_byte> row(map.width());
    for (int y = 0; y < map.height(); y++) {
      const std::uint16_t* in = map.levels[0].row(y);
      if (small) std::copy_n(in, map.width(), row.begin());
      png_write_row(out.png, small ? row.data() : reinterpret_cast<const png_byte*>(in));
    }
    out.finish();
  });
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
