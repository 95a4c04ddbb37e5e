#include "burnish/palette/files/exr_palette.h"

#include <cstring>

#include "burnish/core/error.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {
namespace {

// Null where the file says nothing, or something of another type.
template <typename T>
const T* attribute(const ExrReader& in, const std::string& name) {
  const ExrValue* value = in.attribute(name);
  return value ? std::get_if<T>(value) : nullptr;
}

}  // namespace

ExrAttributes palette_attributes(const Palette& palette) {
  std::vector<float> flat(palette.normals.size() * 3);
  std::memcpy(flat.data(), palette.normals.data(), flat.size() * sizeof(float));
  return {{"burnish:palette", std::move(flat)},
          {"burnish:materials", materials_to_json(palette.materials)},
          {"burnish:space", std::string(name(palette.space))},
          {"burnish:y", std::string("up")},
          {"burnish:format", 1}};
}

Palette extract_palette(const ExrReader& in, const FileRef& file) {
  const auto* flat = attribute<std::vector<float>>(in, "burnish:palette");
  if (!flat || flat->size() % 3 != 0)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected a palette of normals in the attribute burnish:palette");
  if (const auto* format = attribute<int>(in, "burnish:format"); format && *format != 1)
    throw file_error(ErrorKind::kUnsupported, file.name, "expected burnish:format 1, got " + std::to_string(*format));
  Palette palette;
  for (std::size_t i = 0; i < flat->size(); i += 3)
    palette.normals.push_back({(*flat)[i], (*flat)[i + 1], (*flat)[i + 2]});
  const auto* materials = attribute<std::string>(in, "burnish:materials");
  palette.materials = materials ? materials_from_json(*materials, file.name)
                                : std::vector<MaterialInterval>{{0, 0, int(palette.normals.size())}};
  if (const auto* space = attribute<std::string>(in, "burnish:space"))
    palette.space = space_from_name(*space, file.name);
  if (const auto* y = attribute<std::string>(in, "burnish:y")) require_y_up(*y, file.name);
  validate(palette, file.name);
  return palette;
}

std::optional<Palette> read_palette_exr(const FileRef& file) {
  const ExrReader in(file);
  return in.attribute("burnish:palette") ? std::optional(extract_palette(in, file)) : std::nullopt;
}

void write_palette_exr(const FileRef& file, const Palette& palette) {
  const int n = int(palette.normals.size());
  ExrWriter out(file, {n, 1, 1, {"R", "G", "B"}, ExrType::kFloat, palette_attributes(palette), kIndexZipLevel});
  out.write_rows(0, 1, palette.normals.data());
  out.close();
}

}  // namespace burnish::detail
