// The indexed normal map: indices into a palette of unit normals, sorted by material (Tarini et al., sections 4 and 6).
//
// A texel's material is not stored: the palette is cut into intervals, one a material, and the index falls into one of
// them. Inside an interval entries follow a space-filling curve, so that neighbouring indices are neighbouring normals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"
#include "burnish/normal/coding.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

constexpr int kMaxPaletteSize = 65536;

struct MaterialInterval {
  int id = 0;  // 0 … 255
  int first = 0, count = 0;
  friend bool operator==(const MaterialInterval&, const MaterialInterval&) = default;
};

struct Palette {
  std::vector<Vec3f> normals;               // unit, +y up; 1 … 65536
  std::vector<MaterialInterval> materials;  // ascending first, covering all normals, ids distinct
  NormalSpace space = NormalSpace::kTangent;

  // Position in `materials` of the interval that holds an index; indices are valid.
  int interval_of(int index) const;
};

struct IndexedMap {
  Palette palette;
  std::vector<IndexImage> levels;  // level 0 is the base; each side of the next is ⌊n/2⌋, at least 1

  int width() const { return levels[0].width; }
  int height() const { return levels[0].height; }
};

// Whether a file is an indexed normal map: an EXR with a channel `index`, a PNG with a palette or our text chunk, a
// KTX2 or DDS of unsigned integers.
bool is_indexed_map(const FileRef& file);

// Reads what write_indexed_map writes, foreign PNGs with a palette (normals stored biased in PLTE, one material;
// `green` tells which way their y points), and foreign KTX2 and DDS of one channel of 8 or 16 bit unsigned integers.
// Files that hold indices only, as every DDS does, need `palette`, which is read as read_palette does: kUsage without
// it, and where it is given for a file with a palette of its own. kMalformed where an index is beyond the palette, an
// interval is wrong, a level has the wrong size or a normal no length.
IndexedMap read_indexed_map(const FileRef& file, GreenAxis green = GreenAxis::kUp, const FileRef& palette = {});

// Whether a file holds normals for entries: what write_indexed_map and write_palette write, not a PNG with the colours
// of another program. Errors of files that cannot be read.
bool has_own_palette(const FileRef& file);

// The palette alone: of an indexed map, of a file written by write_palette, or of any image N×1 of normals stored as
// its type says (one material; `green` tells which way its y points).
Palette read_palette(const FileRef& file, GreenAxis green = GreenAxis::kUp);

// PNG holds one level; EXR, KTX2 and DDS a chain: kUnsupported otherwise, and for other types.
void require_can_hold_levels(const FileRef& file, FileType type, int levels);

// PNG holds one level, EXR one or all, KTX2 and DDS any number: kUnsupported otherwise, and for other types. A DDS does
// not hold the palette: write_palette puts it beside. The same map gives the same bytes.
void write_indexed_map(const FileRef& file, FileType type, const IndexedMap& map);
// An N×1 image of the normals with the intervals beside them: EXR (float) or PNG (8-bit, exact values in its text).
void write_palette(const FileRef& file, FileType type, const Palette& palette);

}  // namespace burnish
