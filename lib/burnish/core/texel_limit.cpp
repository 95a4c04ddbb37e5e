#include "burnish/core/texel_limit.h"

#include <atomic>

#include "burnish/core/error.h"

namespace burnish {
namespace {

std::atomic<std::int64_t> g_most = kDefaultTexelLimit;

}  // namespace

void set_texel_limit(std::int64_t most) { g_most = most; }

void require_within_texel_limit(const std::string& name, std::uint32_t width, std::uint32_t height) {
  const std::uint64_t texels = std::uint64_t(width) * height;
  if (texels <= std::uint64_t(g_most)) return;
  throw Error(ErrorKind::kUnsupported, "max-texels: expected at least " + std::to_string(texels) + " for '" + name +
                                           "' of " + std::to_string(width) + "x" + std::to_string(height) +
                                           " texels, got " + std::to_string(g_most));
}

}  // namespace burnish
