// The file formats of indexed maps, one source file each; burnish/palette/indexed_rows.h chooses among them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

// What the formats carry as text beside the indices, and its checks.
std::string materials_to_json(const std::vector<MaterialInterval>& materials);
std::vector<MaterialInterval> materials_from_json(const std::string& json, const std::string& file_name);
// kUnsupported unless the file's normals have +y up, as all of this room's do.
void require_y_up(const std::string& y, const std::string& file_name);
// kMalformed where no codec could unpack so many samples from the file: a few bytes must not make us ask for gigabytes.
void require_room_for(const FileRef& file, std::int64_t width, std::int64_t height, std::int64_t bits);
// kMalformed unless the intervals cover the palette in ascending order, each id once, and normals have a length; those
// that are not unit to 1e-4 are made so.
void validate(Palette& palette, const std::string& file_name);

// A map that is read row by row. It leaves it to its caller to validate the palette, which may have no normals where
// the file holds indices only, and the indices.
class IndexSource {
 public:
  virtual ~IndexSource() = default;
  // Rows [first, first + count) of a level; in any order, ascending is fast.
  virtual void read_rows(int level, int first, int count, std::uint16_t* out) = 0;

  Palette palette;
  int width = 0, height = 0, levels = 1;  // each level's size follows from the base's, as core/mip.h says
};

// A map that is written row by row: each level's rows from the top, the levels as they come.
class IndexTarget {
 public:
  virtual ~IndexTarget() = default;
  virtual void write_rows(int level, int count, const std::uint16_t* rows) = 0;
  // After the last row of all levels: reports what only closing can reveal.
  virtual void close() = 0;
};

// The palette and the size, in texels, of a map that is to be written.
struct IndexShape {
  const Palette& palette;
  int width, height, levels;
};

enum class IndexFormat { kPng, kExr, kKtx2, kDds, kOther };

// By the file's first bytes: what it is if it is an indexed map. Errors of files that cannot be read.
IndexFormat format_of(const FileRef& file);
// Null where the file is no indexed map.
std::unique_ptr<IndexSource> open_indexed(const FileRef& file, IndexFormat format, GreenAxis green);

// PNG: up to 256 entries as colour type 3, more as 16-bit grey; everything else in an iTXt chunk `burnish`. One level.
bool is_indexed_png(const FileRef& file);
std::unique_ptr<IndexSource> open_indexed_png(const FileRef& file, GreenAxis green);
std::unique_ptr<IndexTarget> create_indexed_png(const FileRef& file, const IndexShape& shape);
// N×1 RGB of the palette alone; none where the file is no such image of ours.
std::optional<Palette> read_palette_png(const FileRef& file);
void write_palette_png(const FileRef& file, const Palette& palette);

// EXR: one UINT channel `index`, palette and intervals in attributes. One level, or all.
bool is_indexed_exr(const FileRef& file);
std::unique_ptr<IndexSource> open_indexed_exr(const FileRef& file);
std::unique_ptr<IndexTarget> create_indexed_exr(const FileRef& file, const IndexShape& shape);
// N×1 float RGB with the same attributes.
std::optional<Palette> read_palette_exr(const FileRef& file);
void write_palette_exr(const FileRef& file, const Palette& palette);

// KTX2: VK_FORMAT_R8_UINT or R16_UINT, palette and intervals as key/value data. What is read has no normals where the
// file holds no palette. kUnsupported for other formats, arrays, cubes, volumes, supercompression.
bool is_indexed_ktx2(const FileRef& file);
std::unique_ptr<IndexSource> open_indexed_ktx2(const FileRef& file);
std::unique_ptr<IndexTarget> create_indexed_ktx2(const FileRef& file, const IndexShape& shape);

// DDS: DXGI_FORMAT_R8_UINT or R16_UINT, indices only: what is read has no normals. kUnsupported
// for other formats, arrays, cubes, volumes.
bool is_indexed_dds(const FileRef& file);
std::unique_ptr<IndexSource> open_indexed_dds(const FileRef& file);
std::unique_ptr<IndexTarget> create_indexed_dds(const FileRef& file, const IndexShape& shape);

}  // namespace burnish::detail
