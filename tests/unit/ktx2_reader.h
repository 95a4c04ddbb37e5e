// A reader of KTX 2.0 files that insists on the specification's rules (Khronos, "KTX File Format Specification",
// version 2.0, sections 2 to 4) for 2D textures of one unsigned integer channel; it knows nothing of the library's own.
// Throws where a rule is broken.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace burnish::testing {

struct Ktx2 {
  std::uint32_t format, type_size, width, height, level_count;
  std::vector<std::pair<std::string, std::string>> key_values;
  std::vector<std::vector<std::uint16_t>> levels;  // from the base up

  const std::string& value(const std::string& key) const {
    for (const auto& [k, v] : key_values)
      if (k == key) return v;
    throw std::runtime_error("no key " + key);
  }
};

inline Ktx2 read_ktx2(const std::string& file) {
  const auto rule = [](bool holds, const std::string& text) {
    if (!holds) throw std::runtime_error("KTX2: " + text);
  };
  const auto at = [&]<typename T>(std::size_t offset, T) {
    rule(offset + sizeof(T) <= file.size(), "a field beyond the end");
    T value;
    std::memcpy(&value, file.data() + offset, sizeof value);
    return value;
  };
  const auto u8 = [&](std::size_t o) { return at(o, std::uint8_t()); };
  const auto u16 = [&](std::size_t o) { return at(o, std::uint16_t()); };
  const auto u32 = [&](std::size_t o) { return at(o, std::uint32_t()); };
  const auto u64 = [&](std::size_t o) { return at(o, std::uint64_t()); };

  // Identifier and header.
  const unsigned char identifier[] = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32, 0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
  rule(file.size() >= 80 && std::memcmp(file.data(), identifier, 12) == 0, "identifier");
  Ktx2 k{u32(12), u32(16), u32(20), u32(24), u32(40), {}, {}};
  rule(k.format == 13 || k.format == 74, "VK_FORMAT_R8_UINT or VK_FORMAT_R16_UINT");
  const std::uint32_t bytes = k.format == 13 ? 1 : 2;
  rule(k.type_size == bytes, "typeSize is that of a component");
  rule(k.width > 0 && k.height > 0, "a 2D texture");
  rule(u32(28) == 0, "pixelDepth 0");
  rule(u32(32) == 0, "layerCount 0: no array");
  rule(u32(36) == 1, "faceCount 1: no cube");
  std::uint32_t most = 1;
  while (std::max(k.width, k.height) >> most) most++;
  rule(k.level_count >= 1 && k.level_count <= most, "levelCount");
  rule(u32(44) == 0, "no supercompression");

  // Index.
  const std::uint32_t dfd = u32(48), dfd_size = u32(52), kvd = u32(56), kvd_size = u32(60);
  rule(u64(64) == 0 && u64(72) == 0, "no supercompression global data");
  rule(dfd == 80 + 24 * k.level_count, "the descriptor follows the level index");
  rule(kvd == dfd + dfd_size, "key/value data follow the descriptor");

  // Data format descriptor: one basic block with one sample.
  rule(dfd_size == 44 && u32(dfd) == dfd_size, "dfdTotalSize");
  rule(u32(dfd + 4) == 0, "vendor Khronos, basic format");
  rule(u16(dfd + 8) == 2 && u16(dfd + 10) == 40, "version 1.3, block of 40 bytes");
  rule(u8(dfd + 12) == 1, "KHR_DF_MODEL_RGBSDA");
  rule(u8(dfd + 13) == 0, "primaries unspecified: these are no colours");
  rule(u8(dfd + 14) == 1, "KHR_DF_TRANSFER_LINEAR");
  rule(u8(dfd + 15) == 0, "no flags");
  rule(u32(dfd + 16) == 0, "blocks of one texel");
  rule(u32(dfd + 20) == bytes && u32(dfd + 24) == 0, "bytesPlane0 is a texel's size, and no other plane");
  rule(u16(dfd + 28) == 0 && u8(dfd + 30) == 8 * bytes - 1, "bitOffset 0, bitLength less one");
  rule(u8(dfd + 31) == 0, "red; neither signed nor float");
  rule(u32(dfd + 32) == 0, "samplePosition");
  rule(u32(dfd + 36) == 0 && u32(dfd + 40) == 1, "sampleLower 0 and sampleUpper 1: integers that are not normalised");

  // Key/value data.
  for (std::size_t i = kvd; i < kvd + kvd_size;) {
    const std::uint32_t size = u32(i);
    rule(size >= 2 && i + 4 + size <= kvd + kvd_size, "keyAndValueByteLength");
    const std::string both = file.substr(i + 4, size);
    const std::size_t nul = both.find('\0');
    rule(nul != std::string::npos && nul > 0, "a key ends in a NUL");
    k.key_values.emplace_back(both.substr(0, nul), both.substr(nul + 1));
    for (i += 4 + size; i % 4 != 0; i++) rule(u8(i) == 0, "valuePadding is 0");
    rule(i <= kvd + kvd_size, "valuePadding counts");
  }
  for (std::size_t i = 0; i < k.key_values.size(); i++) {
    const std::string& key = k.key_values[i].first;
    if (i) rule(k.key_values[i - 1].first < key, "keys are sorted, each once");
    if (key.starts_with("KTX") || key.starts_with("ktx"))
      rule(key == "KTXorientation" || key == "KTXwriter", "KTX keys are reserved");
  }

  // Levels: the index begins at the base, the file with the smallest; lcm(1 or 2, 4) aligns them.
  std::uint64_t end = kvd + kvd_size;
  k.levels.resize(k.level_count);
  for (std::uint32_t l = k.level_count; l-- > 0;) {
    const std::uint64_t offset = u64(80 + 24 * l), size = u64(88 + 24 * l);
    const std::uint64_t texels = std::uint64_t(std::max(1u, k.width >> l)) * std::max(1u, k.height >> l);
    for (; end % 4 != 0; end++) rule(u8(end) == 0, "mipPadding is 0");
    rule(offset == end, "a level follows the next smaller one");
    rule(size == texels * bytes && u64(96 + 24 * l) == size, "byteLength and uncompressedByteLength");
    for (std::uint64_t t = 0; t < texels; t++) k.levels[l].push_back(bytes == 1 ? u8(offset + t) : u16(offset + 2 * t));
    end = offset + size;
  }
  rule(end == file.size(), "nothing follows the base");
  return k;
}

}  // namespace burnish::testing
