#include "burnish/palette/files/indexed_files.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "burnish/core/error.h"
#include "burnish/core/sound_header.h"
#include "burnish/core/texel_limit.h"

namespace burnish::detail {
namespace {

std::unique_ptr<IndexSource> open_if_indexed(const FileRef& file, IndexFormat format, GreenAxis green) {
  if (format == IndexFormat::kPng && is_indexed_png(file)) return open_indexed_png(file, green);
  if (format == IndexFormat::kExr && is_indexed_exr(file)) return open_indexed_exr(file);
  if (format == IndexFormat::kKtx2) return open_indexed_ktx2(file);
  if (format == IndexFormat::kDds) return open_indexed_dds(file);
  return nullptr;
}

}  // namespace

IndexFormat format_of(const FileRef& file) {
  require_readable(file);
  require_sound_header(file);
  std::ifstream in(file.path, std::ios::binary);
  char head[12] = {};
  in.read(head, sizeof head);
  const std::string_view h(head, sizeof head);
  if (h.starts_with("\x89PNG\r\n\x1a\n")) return IndexFormat::kPng;
  if (h.starts_with("v/1\x01")) return IndexFormat::kExr;
  if (h == "\xabKTX 20\xbb\r\n\x1a\n") return IndexFormat::kKtx2;
  if (h.starts_with("DDS ")) return IndexFormat::kDds;
  return IndexFormat::kOther;
}

std::unique_ptr<IndexSource> open_indexed(const FileRef& file, IndexFormat format, GreenAxis green) {
  std::unique_ptr<IndexSource> source = open_if_indexed(file, format, green);
  if (source) require_within_texel_limit(file.name, std::uint32_t(source->width), std::uint32_t(source->height));
  return source;
}

std::string materials_to_json(const std::vector<MaterialInterval>& materials) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MaterialInterval& m : materials) json.push_back({{"id", m.id}, {"first", m.first}, {"count", m.count}});
  return json.dump();
}

std::vector<MaterialInterval> materials_from_json(const std::string& text, const std::string& file_name) {
  std::vector<MaterialInterval> out;
  const auto refuse = [&] {
    return file_error(ErrorKind::kMalformed, file_name, "expected a list of material intervals in burnish:materials");
  };
  // Fractions would be cut off, and numbers beyond an int wrap.
  const auto number = [&](const nlohmann::json& v) {
    if (!v.is_number_integer() || v < 0 || v > kMaxPaletteSize) throw refuse();
    return v.get<int>();
  };
  try {
    for (const nlohmann::json& m : nlohmann::json::parse(text))
      out.push_back({number(m.at("id")), number(m.at("first")), number(m.at("count"))});
  } catch (const nlohmann::json::exception&) {
    throw refuse();
  }
  return out;
}

void require_y_up(const std::string& y, const std::string& file_name) {
  if (y != "up")
    throw file_error(ErrorKind::kUnsupported, file_name,
                     "expected normals with burnish:y up, got '" + excerpt(y) + "'");
}

void require_room_for(const FileRef& file, std::int64_t width, std::int64_t height, std::int64_t bits) {
  constexpr std::uint64_t kMostExpansion = 1032;  // of deflate
  std::error_code unknown;
  const std::uint64_t bytes = std::filesystem::file_size(file.path, unknown);
  if (!unknown && std::uint64_t(width) * std::uint64_t(height) / 8 * std::uint64_t(bits) > kMostExpansion * bytes)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "is too short for " + std::to_string(width) + "x" + std::to_string(height) + " texels");
}

void validate(Palette& palette, const std::string& file_name) {
  const int n = int(palette.normals.size());
  if (n < 1 || n > kMaxPaletteSize)
    throw file_error(ErrorKind::kMalformed, file_name,
                     "expected a palette of 1 to 65536 normals, got " + std::to_string(n));
  int next = 0;
  bool seen[256] = {};
  for (const MaterialInterval& m : palette.materials) {
    if (m.first != next || m.count < 1 || m.count > n - next || m.id < 0 || m.id > 255 || seen[m.id])
      throw file_error(
          ErrorKind::kMalformed, file_name,
          "material intervals do not cover the palette of " + std::to_string(n) + " in order, each id once");
    seen[m.id] = true;
    next += m.count;
  }
  if (next != n)
    throw file_error(
        ErrorKind::kMalformed, file_name,
        "material intervals cover " + std::to_string(next) + " of " + std::to_string(n) + " palette entries");
  for (Vec3f& v : palette.normals) {
    const double l = length(Vec3d(v));
    if (!(l > 1e-3 && std::isfinite(l)))
      throw file_error(ErrorKind::kMalformed, file_name,
                       "expected unit normals in the palette, got one without a direction");
    if (std::abs(l - 1) > 1e-4) v = Vec3f(Vec3d(v) / l);
  }
}

}  // namespace burnish::detail
