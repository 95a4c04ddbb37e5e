// A reader of DDS files from the published structures (Microsoft, "Programming Guide for DDS": DDS_HEADER,
// DDS_PIXELFORMAT, DDS_HEADER_DXT10) for 2D textures of one unsigned integer channel; it knows nothing of the library's
// own. Throws where what a writer must fill in is missing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace burnish::testing {

struct DdsPixelFormat {
  std::uint32_t size, flags;
  char four_cc[4];
  std::uint32_t bits, red, green, blue, alpha;
};

struct DdsHeader {
  std::uint32_t size, flags, height, width, pitch_or_linear_size, depth, mip_map_count, reserved[11];
  DdsPixelFormat format;
  std::uint32_t caps, caps2, caps3, caps4, reserved2;
};

struct DdsHeaderDxt10 {
  std::uint32_t dxgi_format, resource_dimension, misc_flag, array_size, misc_flags2;
};

struct DdsStart {
  char magic[4];
  DdsHeader header;
  DdsHeaderDxt10 dxt10;
};
static_assert(sizeof(DdsStart) == 148);

struct Dds {
  DdsStart start;
  std::vector<std::vector<std::uint16_t>> levels;  // from the base up
};

inline Dds read_dds(const std::string& file) {
  const auto rule = [](bool holds, const std::string& text) {
    if (!holds) throw std::runtime_error("DDS: " + text);
  };
  Dds dds;
  rule(file.size() >= sizeof dds.start, "too short for its headers");
  std::memcpy(&dds.start, file.data(), sizeof dds.start);
  const DdsHeader& h = dds.start.header;
  const DdsHeaderDxt10& x = dds.start.dxt10;
  rule(std::memcmp(dds.start.magic, "DDS ", 4) == 0, "magic number");
  rule(h.size == 124 && h.format.size == 32, "sizes of the structures");
  constexpr std::uint32_t kRequired = 0x1 | 0x2 | 0x4 | 0x1000;  // caps, height, width, pixel format
  rule((h.flags & kRequired) == kRequired, "required flags");
  rule(h.flags & 0x8 && !(h.flags & 0x80000), "pitch of an uncompressed texture, not linear size");
  rule(h.format.flags == 0x4 && std::memcmp(h.format.four_cc, "DX10", 4) == 0, "FourCC DX10");
  rule(h.caps & 0x1000, "DDSCAPS_TEXTURE");
  rule(h.caps2 == 0 && h.caps3 == 0 && h.caps4 == 0, "no cube, no volume");
  rule(x.dxgi_format == 62 || x.dxgi_format == 57, "DXGI_FORMAT_R8_UINT or DXGI_FORMAT_R16_UINT");
  const std::uint32_t bytes = x.dxgi_format == 62 ? 1 : 2;
  rule(x.resource_dimension == 3 && x.array_size == 1 && x.misc_flag == 0, "one 2D texture");
  rule(x.misc_flags2 == 0, "reserved bits, alpha mode unknown");
  rule(h.width > 0 && h.height > 0 && h.pitch_or_linear_size == h.width * bytes, "pitch");
  rule(h.flags & 0x20000 && h.mip_map_count >= 1, "mip map count");
  const bool chain = h.mip_map_count > 1;
  rule(chain == bool(h.caps & 0x400000) && chain == bool(h.caps & 0x8),
       "DDSCAPS_MIPMAP and DDSCAPS_COMPLEX of a chain");
  std::size_t at = sizeof dds.start;
  for (std::uint32_t l = 0; l < h.mip_map_count; l++) {
    const std::size_t texels = std::size_t(std::max(1u, h.width >> l)) * std::max(1u, h.height >> l);
    rule(at + texels * bytes <= file.size(), "too short for its texels");
    std::vector<std::uint16_t>& level = dds.levels.emplace_back();
    for (std::size_t t = 0; t < texels; t++, at += bytes) {
      std::uint16_t index = 0;
      std::memcpy(&index, file.data() + at, bytes);
      level.push_back(index);
    }
  }
  rule(at == file.size(), "nothing follows the last level");
  return dds;
}

}  // namespace burnish::testing
