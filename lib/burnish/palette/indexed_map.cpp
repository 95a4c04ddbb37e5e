#include "burnish/palette/indexed_map.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish {
namespace {

enum class Signature { kPng, kExr, kKtx2, kDds, kOther };

Signature signature(const FileRef& file) {
  require_readable(file);
  std::ifstream in(file.path, std::ios::binary);
  char head[12] = {};
  in.read(head, sizeof head);
  const std::string_view h(head, sizeof head);
  if (h.starts_with("\x89PNG\r\n\x1a\n")) return Signature::kPng;
  if (h.starts_with("v/1\x01")) return Signature::kExr;
  if (h == "\xabKTX 20\xbb\r\n\x1a\n") return Signature::kKtx2;
  if (h.starts_with("DDS ")) return Signature::kDds;
  return Signature::kOther;
}

// By a file that is one; none where it is none, or no file that can be.
std::optional<IndexedMap> read_any(const FileRef& file, Signature s, GreenAxis green) {
  if (s == Signature::kPng && detail::is_indexed_png(file)) return detail::read_indexed_png(file, green);
  if (s == Signature::kExr && detail::is_indexed_exr(file)) return detail::read_indexed_exr(file);
  if (s == Signature::kKtx2) return detail::read_indexed_ktx2(file);
  if (s == Signature::kDds) return detail::read_indexed_dds(file);
  return std::nullopt;
}

}  // namespace

int Palette::interval_of(int index) const {
  const auto after = std::upper_bound(materials.begin(), materials.end(), index,
                                      [](int i, const MaterialInterval& m) { return i < m.first; });
  return int(after - materials.begin()) - 1;
}

bool is_indexed_map(const FileRef& file) {
  switch (signature(file)) {
    case Signature::kPng:
      return detail::is_indexed_png(file);
    case Signature::kExr:
      return detail::is_indexed_exr(file);
    case Signature::kKtx2:
      return detail::is_indexed_ktx2(file);
    case Signature::kDds:
      return detail::is_indexed_dds(file);
    default:
      return false;
  }
}

IndexedMap read_indexed_map(const FileRef& file, GreenAxis green, const FileRef& palette) {
  std::optional<IndexedMap> map = read_any(file, signature(file), green);
  if (!map) {
    ImageReader reader(file);  // damaged, missing and foreign files say what they are
    throw file_error(
        ErrorKind::kMalformed, file.name,
        "expected an indexed normal map (EXR with a channel 'index', PNG with a palette, KTX2 or DDS), got " +
            std::to_string(reader.channels()) + (reader.channels() == 1 ? " channel" : " channels") + " of " +
            name(reader.sample_type()));
  }
  const bool own = !map->palette.normals.empty();
  if (own && !palette.empty())
    throw Error(ErrorKind::kUsage, "palette: '" + file.name + "' holds its own palette, and takes no other");
  if (!own && palette.empty())
    throw Error(ErrorKind::kUsage, "palette: expected the file of the palette of '" + file.name +
                                       "', which holds indices only, got nothing");
  if (!own) map->palette = read_palette(palette, green);
  detail::validate(*map, file.name);
  return *std::move(map);
}

bool has_own_palette(const FileRef& file) {
  switch (signature(file)) {
    case Signature::kPng:
      return detail::read_palette_png(file).has_value();
    case Signature::kExr:
      return detail::is_indexed_exr(file) || detail::read_palette_exr(file);
    case Signature::kKtx2:
    case Signature::kDds:
      return true;
    default:
      return false;
  }
}

Palette read_palette(const FileRef& file, GreenAxis green) {
  const Signature s = signature(file);
  if (std::optional<IndexedMap> map = read_any(file, s, green)) {
    if (map->palette.normals.empty())
      throw file_error(ErrorKind::kMalformed, file.name, "expected a palette, got a map that holds indices only");
    detail::validate(*map, file.name);
    return std::move(map->palette);
  }
  std::optional<Palette> own;
  if (s == Signature::kPng) own = detail::read_palette_png(file);
  if (s == Signature::kExr) own = detail::read_palette_exr(file);
  if (own) return *own;
  NormalCoding coding;
  coding.green = green;
  NormalReader reader(file, coding);
  if (reader.height() != 1 || reader.width() > kMaxPaletteSize)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected an indexed normal map or a palette of N x 1 texels, got " +
                         std::to_string(reader.width()) + "x" + std::to_string(reader.height()));
  Palette palette;
  palette.normals.resize(reader.width());
  reader.read_rows(0, 1, palette.normals.data());
  palette.materials = {{0, 0, reader.width()}};
  return palette;
}

void require_can_hold_levels(const FileRef& file, FileType type, int levels) {
  using enum FileType;
  if (type != kExr && type != kPng && type != kKtx2 && type != kDds)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     std::string("an indexed normal map is written as EXR, PNG, KTX2 or DDS, not ") + name(type));
  if (type == kPng && levels > 1)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "PNG holds one level, not " + std::to_string(levels) +
                         " (EXR, KTX2 and DDS hold all; --split writes one file a level)");
}

void write_indexed_map(const FileRef& file, FileType type, const IndexedMap& map) {
  require_can_hold_levels(file, type, int(map.levels.size()));
  if (type == FileType::kExr) detail::write_indexed_exr(file, map);
  else if (type == FileType::kPng) detail::write_indexed_png(file, map);
  else if (type == FileType::kKtx2) detail::write_indexed_ktx2(file, map);
  else detail::write_indexed_dds(file, map);
}

void write_palette(const FileRef& file, FileType type, const Palette& palette) {
  if (type == FileType::kExr) return detail::write_palette_exr(file, palette);
  if (type == FileType::kPng) return detail::write_palette_png(file, palette);
  throw file_error(ErrorKind::kUnsupported, file.name,
                   std::string("a palette is written as EXR or PNG, not ") + name(type));
}

namespace detail {

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

void validate(IndexedMap& map, const std::string& file_name) {
  validate(map.palette, file_name);
  const std::size_t n = map.palette.normals.size();
  for (std::size_t l = 0; l < map.levels.size(); l++) {
    const IndexImage& level = map.levels[l];
    if (l > 0 && (level.width != next_level_size(map.levels[l - 1].width) ||
                  level.height != next_level_size(map.levels[l - 1].height)))
      throw file_error(ErrorKind::kMalformed, file_name, "mip level " + std::to_string(l) + " has the wrong size");
    const std::uint16_t most = level.data.empty() ? 0 : *std::ranges::max_element(level.data);
    if (most >= n)
      throw file_error(ErrorKind::kMalformed, file_name,
                       "expected indices below " + std::to_string(n) + ", got " + std::to_string(most) + " in level " +
                           std::to_string(l));
  }
}

}  // namespace detail
}  // namespace burnish
