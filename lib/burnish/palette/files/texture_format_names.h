// How messages call the formats of textures: those often met by their names, others by their numbers.
#pragma once

#include <cstdint>
#include <string>

namespace burnish::detail {

std::string dxgi_format_name(std::uint32_t format);    // "DXGI_FORMAT_BC7_UNORM", "DXGI_FORMAT 132"
std::string vulkan_format_name(std::uint32_t format);  // "VK_FORMAT_BC7_UNORM_BLOCK", "VK_FORMAT 1000066013"

}  // namespace burnish::detail
