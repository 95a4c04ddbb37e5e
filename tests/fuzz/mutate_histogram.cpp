// Mutated histograms: nine times in ten what is packed in the zlib stream, otherwise the file as it is.
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "mutator.h"

namespace {

constexpr std::size_t kHead = 20, kSize = 8;  // "burnish-histogram 1\n", the number of bytes packed

}  // namespace

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed) {
  std::vector<std::uint8_t> body(1 << 16);
  uLongf unpacked = body.size();
  const bool is_whole = size > kHead + kSize &&
                        uncompress(body.data(), &unpacked, bytes + kHead + kSize, uLong(size - kHead - kSize)) == Z_OK;
  if (!is_whole || seed % 10 == 0) return LLVMFuzzerMutate(bytes, size, most);
  unpacked = uLongf(LLVMFuzzerMutate(body.data(), unpacked, body.size()));
  std::vector<std::uint8_t> packed(compressBound(unpacked));
  uLongf length = packed.size();
  if (compress2(packed.data(), &length, body.data(), unpacked, 1) != Z_OK || kHead + kSize + length > most) return size;
  for (std::size_t i = 0; i < kSize; i++) bytes[kHead + i] = std::uint8_t(std::uint64_t(unpacked) >> 8 * i);
  std::copy_n(packed.begin(), length, bytes + kHead + kSize);
  return kHead + kSize + length;
}
