#include "burnish/palette/files/png_metadata.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

constexpr const char* kKeyword = "burnish";

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

const std::string* metadata_of(const PngForm& form) {
  const auto found = std::ranges::find(form.texts, kKeyword, &PngText::key);
  return found == form.texts.end() ? nullptr : &found->text;
}

PngText metadata_text(const Palette& palette) { return {kKeyword, metadata(palette), true}; }

std::optional<Palette> read_palette_png(const FileRef& file) {
  const PngReader in(file, PngSamples::kStored);
  const std::string* text = metadata_of(in.form());
  return text ? std::optional(palette_from_metadata(*text, file)) : std::nullopt;
}

void write_palette_png(const FileRef& file, const Palette& palette) {
  std::vector<PngColour> row;
  for (const Vec3f& n : palette.normals) row.push_back(to_colour(n));
  PngWriter out(file, {int(row.size()), 1, 3, 8, {}, {metadata_text(palette)}});
  out.write_rows(1, row.data());
  out.close();
}

}  // namespace burnish::detail
