// How many texels an image may say that it has.
//
// A file of a few bytes can claim 2^62 texels, and one of some megabytes hold 2^32 that are all alike. What reads maps
// in bands takes either in little memory, so the limit is not about memory alone but about what someone meant to be
// read: nobody who builds textures means 60000x60000 unless they say so. Whoever asks sets it once, before anything is
// read.
#pragma once

#include <cstdint>
#include <string>

namespace burnish {

inline constexpr std::int64_t kDefaultTexelLimit = std::int64_t(1) << 30;  // 32768x32768

// For all that this process reads.
void set_texel_limit(std::int64_t most);

// To be asked before anything is set aside or decoded for what a header says. kUnsupported, as `max-texels: …`, where
// an image of that size has more.
void require_within_texel_limit(const std::string& name, std::uint32_t width, std::uint32_t height);

}  // namespace burnish
