// How much memory the machine has.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <limits>

namespace burnish {

// Bytes. What is larger would be granted all the same, and end this process or another as it is filled.
inline std::size_t physical_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::numeric_limits<std::size_t>::max();
  return std::size_t(pages) * std::size_t(bytes);
}

}  // namespace burnish
