// Indexed PNG files through libpng: OpenImageIO neither reads nor writes palettes.
#pragma once

#include <png.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

// libpng reports by a call that must not return; an exception passes through its C frames on this platform, and its
// structs are released by the destructors of PngReader and PngWriter.
struct PngFailure {
  std::string message;
};
// Runs what calls libpng, and says in whose file it failed.
template <typename Body>
auto guarded(const FileRef& file, ErrorKind kind, const Body& body) {
  try {
    return body();
  } catch (const PngFailure& failure) {
    throw file_error(kind, file.name, (kind == ErrorKind::kIo ? "cannot be written: " : "") + failure.message);
  }
}

// A file after its header has been read.
struct PngReader {
  explicit PngReader(const FileRef& file);
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // Of our chunk.
  std::optional<std::string> text() const;
  bool has_palette() const { return png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE; }
  bool is_indexed() const;

  png_structp png = nullptr;
  png_infop info = nullptr;

 private:
  PngReader();
  struct Closer {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::unique_ptr<std::FILE, Closer> stream_;
};

struct PngWriter {
  explicit PngWriter(const FileRef& to);
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  // With the palette in our chunk.
  void header(int width, int height, int depth, int color_type, const Palette& palette);
  void finish();

  png_structp png = nullptr;
  png_infop info = nullptr;

 private:
  CheckedFile file_;
  std::string name_;
};

// What our chunk says.
Palette palette_from_metadata(const std::string& text, const FileRef& file);

inline png_byte to_byte(float v) { return png_byte((0.5f * v + 0.5f) * 255.f + 0.5f); }

}  // namespace burnish::detail
