// EXR files, by OpenEXR: rows of all levels in and out, attributes as they are in the file.
//
// Errors: kMalformed for what is damaged, kIo for what cannot be read or written, kUnsupported for deep files. Of
// several parts the first is read. Blocks and tiles are packed and unpacked side by side, by as many threads as the
// program may use; the file does not depend on that.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "burnish/core/file_ref.h"

namespace burnish::detail {

enum class ExrType { kUint, kHalf, kFloat };
constexpr std::size_t size_of(ExrType type) { return type == ExrType::kHalf ? 2 : 4; }

struct ExrChannel {
  std::string name;
  ExrType type;
};

// Numbers are read from float, floatvector, vectors and matrices.
using ExrValue = std::variant<std::string, std::vector<float>, int>;
using ExrAttributes = std::vector<std::pair<std::string, ExrValue>>;

// Where samples of a channel go: the first texel of the first row that is asked for, and the steps from there.
struct ExrSlice {
  std::string channel;
  ExrType type;  // that of the channel, or kFloat, which takes integers as they are
  void* first;
  std::size_t texel_bytes, row_bytes;
};

class ExrReader {
 public:
  explicit ExrReader(const FileRef& file);
  ~ExrReader();

  const std::vector<ExrChannel>& channels() const;  // by name
  const ExrAttributes& attributes() const;
  const ExrValue* attribute(const std::string& name) const;  // null where there is none

  // Of mip levels; 1 where there are none, and of ripmaps.
  int levels() const;
  bool rounds_down() const;  // sizes of levels; false of ripmaps
  int width(int level = 0) const;
  int height(int level = 0) const;
  struct Windows {
    int x, y;                     // where the texels begin
    int full_width, full_height;  // of the picture they are said to belong to
    bool whole;                   // which they fill
  };
  const Windows& windows() const;

  // Rows [first, first + count) of a level, from its top. In any order; ascending is fast. Of tiled files a few rows of
  // tiles are held, as stored.
  void read_rows(int level, int first, int count, const std::vector<ExrSlice>& to);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// One level is written as scanlines, several as tiles of 64², rounded down; all with zip.
struct ExrForm {
  int width, height;
  int levels;                         // one, or all down to one texel
  std::vector<std::string> channels;  // in the order of rows
  ExrType type;                       // of all of them
  ExrAttributes attributes;
  std::optional<int> zip_level = {};  // OpenEXR's own where none is given
  bool short_vectors = false;         // 1, 2, 3, 9 and 16 numbers become float, v2f, v3f, m33f, m44f
};

class ExrWriter {
 public:
  ExrWriter(const FileRef& file, const ExrForm& form);
  ~ExrWriter();

  // The next rows of a level, channels interleaved. Those of levels beyond the base, which come after it in the file,
  // wait in a temporary file (waiting_levels.h) beside it; rows of several levels may take turns.
  void write_rows(int level, int count, const void* rows);
  // Must be called, after all rows: reports what only closing can reveal.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace burnish::detail
