// Versions of the libraries this room links, for people who report a fault.
#pragma once

#include <string>

namespace burnish {

// ", libimagequant 2.17.0" where it is linked, else empty.
std::string palette_library_versions();

}  // namespace burnish
