// How much memory the machine has, and what is more than that.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "burnish/core/error.h"

namespace burnish {

// Bytes. What is larger would be granted all the same, and end this process or another as it is filled.
inline std::size_t physical_memory() {
  static const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::numeric_limits<std::size_t>::max();
  return std::size_t(pages) * std::size_t(bytes);
}

// Of a file that is to be held whole: kUnsupported where it is larger.
inline void require_memory_for(const std::string& name, std::uint64_t bytes) {
  if (bytes > physical_memory())
    throw file_error(ErrorKind::kUnsupported, name, "is larger than memory: " + std::to_string(bytes) + " bytes");
}

}  // namespace burnish
