// Versions of the libraries this room links, for people who report a fault.
#pragma once

#include <string>

namespace burnish {

// "OpenEXR 3.1.5, libpng 1.6.39, zlib 1.2.13, libimagequant 2.17.0"; the last only where it is linked.
std::string palette_library_versions();

}  // namespace burnish
