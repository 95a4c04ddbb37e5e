#include "burnish/palette/files/texture_format_names.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace burnish::detail {
namespace {

using FormatNames = std::initializer_list<std::pair<std::uint32_t, const char*>>;

std::string name_in(const FormatNames& names, const std::string& type, std::uint32_t format) {
  const auto found = std::ranges::find(names, format, &FormatNames::value_type::first);
  return found != names.end() ? type + "_" + found->second : type + " " + std::to_string(format);
}

}  // namespace

std::string dxgi_format_name(std::uint32_t format) {
  static const FormatNames names{{0, "UNKNOWN"},
                                 {2, "R32G32B32A32_FLOAT"},
                                 {10, "R16G16B16A16_FLOAT"},
                                 {11, "R16G16B16A16_UNORM"},
                                 {28, "R8G8B8A8_UNORM"},
                                 {29, "R8G8B8A8_UNORM_SRGB"},
                                 {34, "R16G16_FLOAT"},
                                 {35, "R16G16_UNORM"},
                                 {41, "R32_FLOAT"},
                                 {42, "R32_UINT"},
                                 {49, "R8G8_UNORM"},
                                 {50, "R8G8_UINT"},
                                 {54, "R16_FLOAT"},
                                 {56, "R16_UNORM"},
                                 {57, "R16_UINT"},
                                 {61, "R8_UNORM"},
                                 {62, "R8_UINT"},
                                 {71, "BC1_UNORM"},
                                 {72, "BC1_UNORM_SRGB"},
                                 {74, "BC2_UNORM"},
                                 {75, "BC2_UNORM_SRGB"},
                                 {77, "BC3_UNORM"},
                                 {78, "BC3_UNORM_SRGB"},
                                 {80, "BC4_UNORM"},
                                 {81, "BC4_SNORM"},
                                 {83, "BC5_UNORM"},
                                 {84, "BC5_SNORM"},
                                 {87, "B8G8R8A8_UNORM"},
                                 {91, "B8G8R8A8_UNORM_SRGB"},
                                 {95, "BC6H_UF16"},
                                 {96, "BC6H_SF16"},
                                 {98, "BC7_UNORM"},
                                 {99, "BC7_UNORM_SRGB"}};
  return name_in(names, "DXGI_FORMAT", format);
}

std::string vulkan_format_name(std::uint32_t format) {
  static const FormatNames names{{0, "UNDEFINED"},
                                 {9, "R8_UNORM"},
                                 {13, "R8_UINT"},
                                 {15, "R8_SRGB"},
                                 {16, "R8G8_UNORM"},
                                 {20, "R8G8_UINT"},
                                 {23, "R8G8B8_UNORM"},
                                 {29, "R8G8B8_SRGB"},
                                 {37, "R8G8B8A8_UNORM"},
                                 {43, "R8G8B8A8_SRGB"},
                                 {44, "B8G8R8A8_UNORM"},
                                 {50, "B8G8R8A8_SRGB"},
                                 {70, "R16_UNORM"},
                                 {74, "R16_UINT"},
                                 {76, "R16_SFLOAT"},
                                 {77, "R16G16_UNORM"},
                                 {83, "R16G16_SFLOAT"},
                                 {91, "R16G16B16A16_UNORM"},
                                 {97, "R16G16B16A16_SFLOAT"},
                                 {98, "R32_UINT"},
                                 {100, "R32_SFLOAT"},
                                 {109, "R32G32B32A32_SFLOAT"},
                                 {131, "BC1_RGB_UNORM_BLOCK"},
                                 {132, "BC1_RGB_SRGB_BLOCK"},
                                 {133, "BC1_RGBA_UNORM_BLOCK"},
                                 {134, "BC1_RGBA_SRGB_BLOCK"},
                                 {135, "BC2_UNORM_BLOCK"},
                                 {136, "BC2_SRGB_BLOCK"},
                                 {137, "BC3_UNORM_BLOCK"},
                                 {138, "BC3_SRGB_BLOCK"},
                                 {139, "BC4_UNORM_BLOCK"},
                                 {140, "BC4_SNORM_BLOCK"},
                                 {141, "BC5_UNORM_BLOCK"},
                                 {142, "BC5_SNORM_BLOCK"},
                                 {143, "BC6H_UFLOAT_BLOCK"},
                                 {144, "BC6H_SFLOAT_BLOCK"},
                                 {145, "BC7_UNORM_BLOCK"},
                                 {146, "BC7_SRGB_BLOCK"},
                                 {147, "ETC2_R8G8B8_UNORM_BLOCK"},
                                 {148, "ETC2_R8G8B8_SRGB_BLOCK"},
                                 {151, "ETC2_R8G8B8A8_UNORM_BLOCK"},
                                 {152, "ETC2_R8G8B8A8_SRGB_BLOCK"},
                                 {157, "ASTC_4x4_UNORM_BLOCK"},
                                 {158, "ASTC_4x4_SRGB_BLOCK"}};
  return name_in(names, "VK_FORMAT", format);
}

}  // namespace burnish::detail
