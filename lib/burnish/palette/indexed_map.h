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

namespace burnish {

constexpr int kMaxPaletteSize = 65536;

enum class NormalSpace { kTangent, kObject };
const char* name(NormalSpace space);  // "tangent", "object"

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

// Whether a file is an indexed normal map: an EXR with a channel `index`, or a PNG with a palette or our text chunk.
bool is_indexed_map(const FileRef& file);

// Reads what write_indexed_map writes, and foreign PNGs with a palette (normals stored biased in PLTE, one material;
// `green` tells which way their y points). kMalformed where an index is beyond the palette, an interval is wrong, a
// level has the wrong size or a normal no length.
IndexedMap read_indexed_map(const FileRef& file, GreenAxis green = GreenAxis::kUp);

// The palette alone: of an indexed map, of a file written by write_palette, or of any image N×1 of normals stored as
// its type says (one material; `green` tells which way its y points).
Palette read_palette(const FileRef& file, GreenAxis green = GreenAxis::kUp);

// PNG holds one level, EXR any chain: kUnsupported otherwise, and for other types.
void require_can_hold_levels(const FileRef& file, FileType type, int levels);

// EXR holds all levels, PNG one: kUnsupported for a chain in a PNG and for other types. The same map gives the same
// bytes.
void write_indexed_map(const FileRef& file, FileType type, const IndexedMap& map);
// An N×1 image of the normals with the intervals beside them: EXR (float) or PNG (8-bit, exact values in its text).
void write_palette(const FileRef& file, FileType type, const Palette& palette);

}  // namespace burnish
