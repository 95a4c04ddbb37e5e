// Indexed normal maps in files, row by row: maps of any size in little memory.
//
// indexed_map.h reads and writes whole ones, and says what files hold and which errors there are.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "burnish/palette/indexed_map.h"

namespace burnish {

namespace detail {
class IndexSource;
class IndexTarget;
}  // namespace detail

// Takes the next `count` rows of indices.
using IndexRowSink = std::function<void(int count, const std::uint16_t* rows)>;

// Appends them to an image in memory, of that width, which outlives it.
IndexRowSink append_to(IndexImage& image, int width);

class IndexedMapReader {
 public:
  // Arguments and errors as read_indexed_map.
  explicit IndexedMapReader(const FileRef& file, GreenAxis green = GreenAxis::kUp, const FileRef& palette = {});
  ~IndexedMapReader();
  IndexedMapReader(IndexedMapReader&&) noexcept;

  const Palette& palette() const;
  int width() const;
  int height() const;
  int levels() const;
  // Rows [first, first + count) of a level; in any order, ascending is fast. kMalformed where an index is beyond the
  // palette.
  void read_rows(int level, int first, int count, std::uint16_t* out);
  // Reads all rows of all levels, for what may be wrong with them.
  void check();

 private:
  std::string name_;
  std::unique_ptr<detail::IndexSource> source_;
};

class IndexedMapWriter {
 public:
  // `levels` of a map of that size. kUnsupported as write_indexed_map. The palette may go before the writer does.
  IndexedMapWriter(const FileRef& file, FileType type, const Palette& palette, int width, int height, int levels = 1);
  ~IndexedMapWriter();
  IndexedMapWriter(IndexedMapWriter&&) noexcept;

  // The next rows of a level, in whatever order the levels come. The last row of all closes the file, and reports what
  // only closing can reveal.
  void write_rows(int level, int count, const std::uint16_t* rows);

 private:
  std::unique_ptr<detail::IndexTarget> target_;
  std::vector<int> rows_left_;  // of each level
};

}  // namespace burnish
