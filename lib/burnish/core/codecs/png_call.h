// How libpng is called: what it says of a failure becomes an exception.
#pragma once

#include <png.h>

#include <string>

#include "burnish/core/error.h"
#include "burnish/core/file_ref.h"

namespace burnish::detail {

// libpng reports by a call that must not return. An exception passes through its C frames on this platform; its structs
// are released by destructors.
struct PngFailure {
  std::string message;
};
[[noreturn]] inline void on_png_error(png_structp, png_const_charp message) { throw PngFailure{message}; }
inline void on_png_warning(png_structp, png_const_charp) {}

// Runs what calls libpng, and says in whose file it failed.
template <typename Body>
auto calling_png(const FileRef& file, ErrorKind kind, const Body& body) {
  try {
    return body();
  } catch (const PngFailure& failure) {
    throw file_error(kind, file.name, (kind == ErrorKind::kIo ? "cannot be written: " : "") + failure.message);
  }
}

}  // namespace burnish::detail
