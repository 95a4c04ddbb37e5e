// Indexed maps in KTX 2.0 (Khronos, "KTX File Format Specification", version 2.0): texels of unsigned integers that any
// loader takes, palette and intervals as key/value data.
#include <algorithm>
#include <bit>
#include <map>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/palette/files/indexed_files.h"
#include "burnish/palette/files/texture_container.h"
#include "burnish/palette/files/texture_format_names.h"

namespace burnish::detail {
namespace {

constexpr std::string_view kIdentifier = "\xabKTX 20\xbb\r\n\x1a\n";
constexpr std::uint32_t kR8Uint = 13, kR16Uint = 74;  // of VkFormat
constexpr std::size_t kHeaderBytes = 80, kLevelBytes = 24;

std::size_t aligned(std::size_t offset) { return (offset + 3) / 4 * 4; }  // of fields, and of texels of 1 or 2 bytes

// The basic block of the Khronos Data Format (1.3, chapter 5): one sample, red, of unsigned integers.
std::string data_format_descriptor(int bytes_per_index) {
  constexpr std::uint32_t kVersion = 2, kRgbsda = 1, kUnspecifiedPrimaries = 0, kLinear = 1, kSampleBytes = 16;
  constexpr std::uint32_t kBlockBytes = 24 + kSampleBytes;
  std::string out;
  for (const std::uint32_t word :
       {4 + kBlockBytes, 0u, kVersion | kBlockBytes << 16, kRgbsda | kUnspecifiedPrimaries << 8 | kLinear << 16,
        0u,                                            // blocks of 1×1×1×1 texels
        std::uint32_t(bytes_per_index), 0u,            // bytesPlane0; no other planes
        std::uint32_t(8 * bytes_per_index - 1) << 16,  // bit 0, so many bits; channel red
        0u, 0u, 1u})                                   // position; 0 and 1 are themselves
    append_u32(out, word);
  return out;
}

void append_entry(std::string& out, const std::string& key, const std::string& value) {
  append_u32(out, std::uint32_t(key.size() + 1 + value.size()));
  out += key + '\0' + value;
  out.resize(aligned(out.size()));
}

// Sorted by key, as the format demands. Text ends in a NUL; the palette's key is as long as it must be for its floats
// to be aligned.
std::string key_value_data(const Palette& palette) {
  std::string normals, out;
  for (const Vec3f& n : palette.normals)
    for (const float v : {n.x, n.y, n.z}) append_u32(normals, std::bit_cast<std::uint32_t>(v));
  const auto text = [](const std::string& s) { return s + '\0'; };
  append_entry(out, "KTXorientation", text("rd"));
  append_entry(out, "KTXwriter", text("burnish " BURNISH_VERSION));
  append_entry(out, "burnish:format", text("1"));
  append_entry(out, "burnish:materials", text(materials_to_json(palette.materials)));
  append_entry(out, "burnish:palette", normals);
  append_entry(out, "burnish:space", text(name(palette.space)));
  append_entry(out, "burnish:y", text("up"));
  return out;
}

using KeyValues = std::map<std::string, std::string>;

KeyValues parse_key_values(const std::string& data, const FileRef& file) {
  KeyValues out;
  for (std::size_t at = 0; at < data.size();) {
    const std::size_t room = data.size() - at;
    const std::size_t size = room < 4 ? 0 : u32_at(data, at);
    const std::size_t nul = room < 4 ? std::string::npos : data.find('\0', at + 4);
    if (room < 4 || size > room - 4 || nul >= at + 4 + size)
      throw file_error(ErrorKind::kMalformed, file.name, "expected keys with values, got damaged ones");
    out.emplace(data.substr(at + 4, nul - at - 4), data.substr(nul + 1, at + 4 + size - nul - 1));
    at = aligned(at + 4 + size);
  }
  return out;
}

// Text of a key, without what ends it; none where there is no such key.
std::optional<std::string> text_of(const KeyValues& values, const std::string& key) {
  const auto found = values.find(key);
  if (found == values.end()) return std::nullopt;
  return found->second.substr(0, found->second.find('\0'));
}

// No normals where the file is none of ours.
Palette palette_of(const KeyValues& values, const FileRef& file) {
  Palette palette;
  const auto normals = values.find("burnish:palette");
  if (normals == values.end()) return palette;
  constexpr std::size_t kEntryBytes = 3 * sizeof(float);
  const std::string& bytes = normals->second;
  if (bytes.empty() || bytes.size() % kEntryBytes != 0)
    throw file_error(
        ErrorKind::kMalformed, file.name,
        "expected three floats a normal in burnish:palette, got " + std::to_string(bytes.size()) + " bytes");
  if (const auto format = text_of(values, "burnish:format").value_or("1"); format != "1")
    throw file_error(ErrorKind::kUnsupported, file.name, "expected burnish:format 1, got '" + excerpt(format) + "'");
  const auto component = [&](std::size_t at) { return std::bit_cast<float>(u32_at(bytes, at)); };
  for (std::size_t i = 0; i < bytes.size(); i += kEntryBytes)
    palette.normals.push_back({component(i), component(i + 4), component(i + 8)});
  const auto materials = text_of(values, "burnish:materials");
  palette.materials = materials ? materials_from_json(*materials, file.name)
                                : std::vector<MaterialInterval>{{0, 0, int(palette.normals.size())}};
  palette.space = space_from_name(text_of(values, "burnish:space").value_or("tangent"), file.name);
  require_y_up(text_of(values, "burnish:y").value_or("up"), file.name);
  return palette;
}

struct Header {
  std::uint32_t format, type_bytes, width, height, depth, layers, faces, levels, supercompression;
  std::uint32_t dfd_offset, dfd_bytes, kvd_offset, kvd_bytes;
};

Header read_header(ContainerReader& in) {
  const std::string head = in.read(0, kHeaderBytes, "the header of a KTX2");
  const auto word = [&](int i) { return u32_at(head, kIdentifier.size() + 4 * std::size_t(i)); };
  return {word(0), word(1), word(2), word(3),  word(4),  word(5), word(6),
          word(7), word(8), word(9), word(10), word(11), word(12)};
}

void require_indices(const Header& h, const FileRef& file) {
  if (h.format != kR8Uint && h.format != kR16Uint)
    throw unsupported(file, "indices as VK_FORMAT_R8_UINT or VK_FORMAT_R16_UINT", vulkan_format_name(h.format));
  if (h.supercompression != 0)
    throw unsupported(file, "no supercompression",
                      h.supercompression == 2   ? "Zstandard"
                      : h.supercompression == 3 ? "ZLIB"
                                                : "scheme " + std::to_string(h.supercompression));
  if (h.depth != 0) throw unsupported(file, "a flat texture", "a volume");
  if (h.layers != 0) throw unsupported(file, "one texture", "an array of " + std::to_string(h.layers));
  if (h.faces != 1) throw unsupported(file, "one face", std::to_string(h.faces));
}

}  // namespace

bool is_indexed_ktx2(const FileRef& file) {
  ContainerReader in(file);
  try {
    const std::uint32_t format = read_header(in).format;
    return format == kR8Uint || format == kR16Uint;
  } catch (const Error&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_ktx2(const FileRef& file) {
  ContainerReader in(file);
  const Header h = read_header(in);
  require_indices(h, file);
  require_sane_levels(file, h.width, h.height, h.levels);
  const KeyValues values = parse_key_values(in.read(h.kvd_offset, h.kvd_bytes, "its keys and values"), file);
  if (const auto orientation = text_of(values, "KTXorientation").value_or("rd"); orientation != "rd")
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected KTXorientation rd, got '" + excerpt(orientation) + "'");
  Palette palette = palette_of(values, file);
  std::vector<std::uint64_t> offsets;
  const std::uint32_t levels = std::max(h.levels, 1u);  // 0: the reader is to make the others
  const std::string index = in.read(kHeaderBytes, levels * kLevelBytes, "the index of its levels");
  const int bytes = h.format == kR8Uint ? 1 : 2;
  const int width = int(h.width), height = int(h.height);
  for (std::uint32_t l = 0; l < levels; l++) {
    const int w = level_size(width, int(l)), rows = level_size(height, int(l));
    const std::uint64_t expected = std::uint64_t(w) * rows * bytes, got = u64_at(index, l * kLevelBytes + 8);
    if (got != expected)
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected " + std::to_string(expected) + " bytes of " + std::to_string(w) + "x" +
                           std::to_string(rows) + " texels in level " + std::to_string(l) + ", got " +
                           std::to_string(got));
    offsets.push_back(u64_at(index, l * kLevelBytes));
  }
  auto source = std::make_unique<ContainerSource>(std::move(in), width, height, std::move(offsets), bytes);
  source->palette = std::move(palette);
  return source;
}

std::unique_ptr<IndexTarget> create_indexed_ktx2(const FileRef& file, const IndexShape& shape) {
  const std::size_t bytes = bytes_per_index(shape.palette.normals.size()), format = bytes == 1 ? kR8Uint : kR16Uint;
  const std::size_t width = std::size_t(shape.width), height = std::size_t(shape.height),
                    levels = std::size_t(shape.levels);
  const std::size_t depth = 0, layers = 0, faces = 1, supercompression = 0;
  const std::string descriptor = data_format_descriptor(int(bytes)), values = key_value_data(shape.palette);
  const std::size_t descriptor_at = kHeaderBytes + kLevelBytes * levels, values_at = descriptor_at + descriptor.size();

  std::string head(kIdentifier);
  for (const std::size_t word : {format, bytes, width, height, depth, layers, faces, levels, supercompression,
                                 descriptor_at, descriptor.size(), values_at, values.size()})
    append_u32(head, std::uint32_t(word));
  append_u64(head, 0), append_u64(head, 0);  // no global data of a compression

  // Levels lie smallest first, so that a loader can show them as they come; their index begins at the base.
  std::vector<std::uint64_t> offsets(levels), sizes;
  for (int l = 0; l < shape.levels; l++)
    sizes.push_back(std::uint64_t(level_size(shape.width, l)) * level_size(shape.height, l) * bytes);
  std::uint64_t end = values_at + values.size();
  for (std::size_t l = levels; l-- > 0;) offsets[l] = aligned(end), end = offsets[l] + sizes[l];
  for (std::size_t l = 0; l < levels; l++)
    for (const std::uint64_t word : {offsets[l], sizes[l], sizes[l]}) append_u64(head, word);
  return std::make_unique<ContainerTarget>(file, head + descriptor + values, shape.width, std::move(offsets),
                                           int(bytes));
}

}  // namespace burnish::detail
