// What the containers of GPU textures, KTX2 and DDS, have in common: little-endian fields, and levels of indices as
// rows without gaps, one byte an index where the palette has up to 256 entries, otherwise two.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/palette/files/indexed_files.h"

namespace burnish::detail {

inline int bytes_per_index(std::size_t normals) { return normals <= 256 ? 1 : 2; }

void append_u32(std::string& out, std::uint32_t value);
void append_u64(std::string& out, std::uint64_t value);
// At an offset that lies inside.
std::uint32_t u32_at(std::string_view bytes, std::size_t offset);
std::uint64_t u64_at(std::string_view bytes, std::size_t offset);

class ContainerReader {
 public:
  explicit ContainerReader(const FileRef& file);
  // kMalformed, before anything is allocated, where the file ends first; `what` names what is read.
  std::string read(std::uint64_t offset, std::uint64_t count, const std::string& what);
  void require(std::uint64_t offset, std::uint64_t count, const std::string& what) const;

 private:
  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::string name_;
};

// Levels of indices at offsets.
class ContainerSource final : public IndexSource {
 public:
  // kMalformed where the file ends before a level does.
  ContainerSource(ContainerReader in, int width, int height, std::vector<std::uint64_t> offsets, int bytes_per_index);
  void read_rows(int level, int first, int count, std::uint16_t* out) override;

 private:
  ContainerReader in_;
  std::vector<std::uint64_t> offsets_;
  int bytes_;
};

class ContainerTarget final : public IndexTarget {
 public:
  // `head` goes in front, the levels of a map of that width to their offsets, zeros between.
  ContainerTarget(const FileRef& file, const std::string& head, int width, std::vector<std::uint64_t> offsets,
                  int bytes_per_index);
  void write_rows(int level, int count, const std::uint16_t* rows) override;
  void close() override;

 private:
  void check() const;
  CheckedFile file_;
  std::string name_;
  int width_;
  std::vector<std::uint64_t> next_;  // where each level's next row goes
  int bytes_;
};

// kUnsupported: 'file': expected …, got …
Error unsupported(const FileRef& file, const std::string& expected, const std::string& got);

// Sizes as a header gives them. kMalformed unless both sides are 1 … 2³¹ − 1 and there are no more levels than lead to
// one texel.
void require_sane_levels(const FileRef& file, std::uint32_t width, std::uint32_t height, std::uint32_t levels);

}  // namespace burnish::detail
