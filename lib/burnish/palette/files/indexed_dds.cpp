// Levels of indices in DDS (Microsoft, "Programming Guide for DDS"): DDS_HEADER, then DDS_HEADER_DXT10, then the levels
// from the base up. It has no place for a palette.
#include <algorithm>
#include <cctype>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/palette/files/indexed_files.h"
#include "burnish/palette/files/texture_container.h"
#include "burnish/palette/files/texture_format_names.h"

namespace burnish::detail {
namespace {

constexpr std::uint32_t kR8Uint = 62, kR16Uint = 57;  // of DXGI_FORMAT
constexpr std::uint32_t kTexture2d = 3;               // of D3D10_RESOURCE_DIMENSION
constexpr std::uint32_t kHeaderBytes = 124, kPixelFormatBytes = 32, kFourCC = 0x4;
constexpr std::size_t kTexelsAt = 148;

// Offsets of fields from the start of the file: those of DDS_HEADER, its pixel format, DDS_HEADER_DXT10.
constexpr std::size_t kSize = 4, kHeight = 12, kWidth = 16, kLevels = 28, kCaps2 = 112;
constexpr std::size_t kPixelFormatSize = 76, kPixelFormatFlags = 80, kPixelFormatFourCC = 84, kPixelFormatBits = 88;
constexpr std::size_t kFormat = 128, kDimension = 132, kMiscFlags = 136, kArraySize = 140;

struct Header {
  std::uint32_t width, height, levels, format;
};

std::string legacy_format_name(std::string_view head) {
  if (!(u32_at(head, kPixelFormatFlags) & kFourCC))
    return std::to_string(u32_at(head, kPixelFormatBits)) + " bits a texel and no DX10 header";
  const std::string_view four = head.substr(kPixelFormatFourCC, 4);
  if (std::ranges::all_of(four, [](unsigned char c) { return std::isprint(c); }))
    return "FourCC '" + std::string(four) + "'";
  return "D3DFORMAT " + std::to_string(u32_at(head, kPixelFormatFourCC));
}

// kUnsupported for other formats and shapes.
Header read_header(ContainerReader& in, const FileRef& file) {
  constexpr const char* kIndices = "indices as DXGI_FORMAT_R8_UINT or DXGI_FORMAT_R16_UINT";
  std::string head = in.read(0, 4 + kHeaderBytes, "the header of a DDS");
  if (u32_at(head, kSize) != kHeaderBytes || u32_at(head, kPixelFormatSize) != kPixelFormatBytes)
    throw file_error(ErrorKind::kMalformed, file.name, "expected the header of a DDS, got a damaged one");
  if (!(u32_at(head, kPixelFormatFlags) & kFourCC) || head.substr(kPixelFormatFourCC, 4) != "DX10")
    throw unsupported(file, kIndices, legacy_format_name(head));
  head = in.read(0, kTexelsAt, "the header of a DDS");
  const std::uint32_t format = u32_at(head, kFormat);
  if (format != kR8Uint && format != kR16Uint) throw unsupported(file, kIndices, dxgi_format_name(format));
  constexpr std::uint32_t kCubeOrVolume = 0x200 | 0x200000, kCube = 0x4;
  if (u32_at(head, kDimension) != kTexture2d || u32_at(head, kCaps2) & kCubeOrVolume ||
      u32_at(head, kMiscFlags) & kCube)
    throw unsupported(file, "a flat texture", "a cube, volume or line");
  if (const std::uint32_t n = u32_at(head, kArraySize); n != 1)
    throw unsupported(file, "one texture", "an array of " + std::to_string(n));
  return {u32_at(head, kWidth), u32_at(head, kHeight), std::max(u32_at(head, kLevels), 1u), format};
}

std::vector<std::uint64_t> offsets_of_levels(int width, int height, int levels, int bytes) {
  std::vector<std::uint64_t> offsets;
  std::uint64_t at = kTexelsAt;
  for (int l = 0; l < levels; l++) {
    offsets.push_back(at);
    at += std::uint64_t(level_size(width, l)) * level_size(height, l) * bytes;
  }
  return offsets;
}

}  // namespace

bool is_indexed_dds(const FileRef& file) {
  ContainerReader in(file);
  try {
    read_header(in, file);
    return true;
  } catch (const Error&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_dds(const FileRef& file) {
  ContainerReader in(file);
  const Header h = read_header(in, file);
  require_sane_levels(file, h.width, h.height, h.levels);
  const int bytes = h.format == kR8Uint ? 1 : 2;
  const int width = int(h.width), height = int(h.height);
  return std::make_unique<ContainerSource>(std::move(in), width, height,
                                           offsets_of_levels(width, height, int(h.levels), bytes), bytes);
}

std::unique_ptr<IndexTarget> create_indexed_dds(const FileRef& file, const IndexShape& shape) {
  constexpr std::uint32_t kCapsField = 0x1, kHeightField = 0x2, kWidthField = 0x4, kPitchField = 0x8,
                          kPixelFormatField = 0x1000, kLevelsField = 0x20000;
  constexpr std::uint32_t kComplex = 0x8, kTexture = 0x1000, kMipmap = 0x400000;
  const int bytes = bytes_per_index(shape.palette.normals.size());
  const std::uint32_t levels = std::uint32_t(shape.levels);

  std::string head = "DDS ";
  for (const std::uint32_t word :
       {kHeaderBytes, kCapsField | kHeightField | kWidthField | kPitchField | kPixelFormatField | kLevelsField,
        std::uint32_t(shape.height), std::uint32_t(shape.width), std::uint32_t(shape.width * bytes), 0u, levels})
    append_u32(head, word);
  head.resize(kPixelFormatSize);  // reserved words
  append_u32(head, kPixelFormatBytes);
  append_u32(head, kFourCC);
  head += "DX10";
  head.resize(kCaps2 - 4);  // masks of formats without a DX10 header
  append_u32(head, kTexture | (levels > 1 ? kComplex | kMipmap : 0));
  head.resize(kFormat);
  for (const std::uint32_t word : {bytes == 1 ? kR8Uint : kR16Uint, kTexture2d, 0u, 1u, 0u}) append_u32(head, word);

  return std::make_unique<ContainerTarget>(file, head, shape.width,
                                           offsets_of_levels(shape.width, shape.height, shape.levels, bytes), bytes);
}

}  // namespace burnish::detail
