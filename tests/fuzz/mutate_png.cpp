// Mutated PNG whose chunks' checksums are right, so that more than them is tested.
#include <zlib.h>

#include "mutator.h"

namespace {

constexpr std::size_t kSignature = 8, kAround = 12;  // bytes; those of a chunk that are not its data

std::uint32_t word_at(const std::uint8_t* p) {
  return std::uint32_t(p[0]) << 24 | std::uint32_t(p[1]) << 16 | std::uint32_t(p[2]) << 8 | p[3];
}

}  // namespace

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned) {
  size = LLVMFuzzerMutate(bytes, size, most);
  if (size < kSignature || bytes[0] != 0x89) return size;
  for (std::size_t at = kSignature; size - at >= kAround;) {
    const std::size_t data = word_at(bytes + at);
    if (data > size - at - kAround) break;
    const auto sum = std::uint32_t(crc32(0, bytes + at + 4, uInt(data + 4)));
    for (int i = 0; i < 4; i++) bytes[at + 8 + data + i] = std::uint8_t(sum >> (24 - 8 * i));
    at += kAround + data;
  }
  return size;
}
