// What the containers of GPU textures, KTX2 and DDS, have in common: little-endian fields, and levels of indices as
// rows without gaps, one byte an index where the palette has up to 256 entries, otherwise two.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/core/image.h"
#include "burnish/core/image_io.h"

namespace burnish::detail {

inline int bytes_per_index(std::size_t normals) { return normals <= 256 ? 1 : 2; }

void append_u32(std::string& out, std::uint32_t value);
void append_u64(std::string& out, std::uint64_t value);
// At an offset that lies inside.
std::uint32_t u32_at(std::string_view bytes, std::size_t offset);
std::uint64_t u64_at(std::string_view bytes, std::size_t offset);

class ContainerWriter {
 public:
  explicit ContainerWriter(const FileRef& file) : file_(file.path), name_(file.name) { check(); }
  void write(std::string_view bytes);
  void write_texels(const IndexImage& level, int bytes_per_index);
  // Must be called: reports what only closing can reveal.
  void close();

 private:
  void check() const;
  CheckedFile file_;
  std::string name_;
};

class ContainerReader {
 public:
  explicit ContainerReader(const FileRef& file);
  // kMalformed, before anything is allocated, where the file ends first; `what` names what is read.
  std::string read(std::uint64_t offset, std::uint64_t count, const std::string& what);
  IndexImage read_texels(std::uint64_t offset, int width, int height, int bytes_per_index);

 private:
  void seek(std::uint64_t offset, std::uint64_t count, const std::string& what);
  void fill(char* to, std::size_t count);
  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::string name_;
};

// kUnsupported: 'file': expected …, got …
Error unsupported(const FileRef& file, const std::string& expected, const std::string& got);

// Sizes as a header gives them. kMalformed unless both sides are 1 … 2³¹ − 1 and there are no more levels than lead to
// one texel.
void require_sane_levels(const FileRef& file, std::uint32_t width, std::uint32_t height, std::uint32_t levels);

}  // namespace burnish::detail
