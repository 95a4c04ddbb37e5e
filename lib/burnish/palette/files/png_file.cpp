#include "burnish/palette/files/png_file.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

constexpr const char* kKeyword = "burnish";

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

}  // namespace

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

PngReader::PngReader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)) {
  info = png_create_info_struct(png);
}

PngReader::PngReader(const FileRef& file) : PngReader() {  // delegating: the destructor runs whatever this throws
  stream_.reset(std::fopen(file.path.c_str(), "rb"));
  if (!stream_) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  png_init_io(png, stream_.get());
  png_read_info(png, info);
}

std::optional<std::string> PngReader::text() const {
  png_textp entries;
  int count = 0;
  png_get_text(png, info, &entries, &count);
  for (int i = 0; i < count; i++)
    if (std::string(entries[i].key) == kKeyword) return entries[i].text ? entries[i].text : "";
  return std::nullopt;
}

bool PngReader::is_indexed() const {
  return has_palette() || (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && text().has_value());
}

PngWriter::PngWriter(const FileRef& to)
    : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning)),
      file_(to.path),
      name_(to.name) {
  info = png_create_info_struct(png);
  png_set_write_fn(
      png, this,
      [](png_structp p, png_bytep bytes, std::size_t size) {
        PngWriter& writer = *static_cast<PngWriter*>(png_get_io_ptr(p));
        if (writer.file_.write(bytes, size) != size) throw writer.file_.error(writer.name_);
      },
      nullptr);
  png_set_compression_level(png, 6);
}

void PngWriter::header(int width, int height, int depth, int color_type, const Palette& palette) {
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

void PngWriter::finish() {
  png_write_end(png, info);
  file_.close();
  if (file_.first_error()) throw file_.error(name_);
}

std::optional<Palette> read_palette_png(const FileRef& file) {
  return guarded(file, ErrorKind::kMalformed, [&]() -> std::optional<Palette> {
    const std::optional<std::string> text = PngReader(file).text();
    return text ? std::optional(palette_from_metadata(*text, file)) : std::nullopt;
  });
}

void write_palette_png(const FileRef& file, const Palette& palette) {
  guarded(file, ErrorKind::kIo, [&] {
    PngWriter out(file);
    out.header(int(palette.normals.size()), 1, 8, PNG_COLOR_TYPE_RGB, palette);
    png_write_info(out.png, out.info);
    std::vector<png_byte> row;
    for (const Vec3f& n : palette.normals) row.insert(row.end(), {to_byte(n.x), to_byte(n.y), to_byte(n.z)});
    png_write_row(out.png, row.data());
    out.finish();
  });
}

}  // namespace burnish::detail
