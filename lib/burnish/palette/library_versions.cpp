#include "burnish/palette/library_versions.h"

#ifdef BURNISH_WITH_IMAGEQUANT
#include <libimagequant.h>
#endif

namespace burnish {

std::string palette_library_versions() {
#ifdef BURNISH_WITH_IMAGEQUANT
  const int v = liq_version();
  return ", libimagequant " + std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." +
         std::to_string(v % 100);
#else
  return "";
#endif
}

}  // namespace burnish
