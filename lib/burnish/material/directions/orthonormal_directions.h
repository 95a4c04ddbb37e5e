// Directions of anisotropy made orthonormal against bump normals (Isidoro & Brennan: T_new = T − (N·T) N, normalised).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "burnish/material/directions/direction_map.h"
#include "burnish/normal/coding.h"

namespace burnish {

// Bump normals of a map in tangent space, or of some rows of it.
struct SurfaceNormals {
  int width = 0, height = 0;
  std::vector<Vec3f> vectors;  // unit
  float error = 0;             // as DirectionMap::error
  std::size_t invalid_texels = 0;
};

// In bands of rows.
class SurfaceNormalReader {
 public:
  // kMalformed as NormalReader, and for a file that says its normals are in object space.
  SurfaceNormalReader(const FileRef& file, const NormalCoding& coding);

  int width() const { return reader_.width(); }
  int height() const { return reader_.height(); }
  // Rows [first, first + count), in any order; ascending is fast.
  SurfaceNormals rows(int first, int count);

 private:
  NormalReader reader_;
};

// All of it. Errors as SurfaceNormalReader.
SurfaceNormals read_surface_normals(const FileRef& file, const NormalCoding& coding);

// Some rows of both maps; without normals vectors keep their z.
struct DirectionBand {
  DirectionMap map;
  std::optional<SurfaceNormals> normals;
};

// Makes every vector unit, and orthogonal to its normal where there are normals. Where it has no length, or is parallel
// to its normal, as far as the samples can tell, the texel takes the direction of the nearest one that is defined (the
// topmost, then the leftmost of equally near ones), then made orthogonal to its own normal, and is counted. With
// `in_plane` the result is turned into the plane of the map, where one that stands upright is not defined either.
// kMalformed where nothing is defined.
//
// read(first, count) gives bands of the maps, take(band) gets them all in their order. From the first texel on that is
// not defined, all is read twice: what comes below may be nearest. Memory is that of a few bands; what is to be known
// of columns that are not defined goes to a temporary file in `directory` (spill_file.h) where it is more than 32 MiB.
// In parallel, each texel by itself.
std::size_t orthonormal_bands(int width, int height, bool in_plane, const std::string& directory,
                              const std::function<DirectionBand(int first, int count)>& read,
                              const std::function<void(DirectionBand& band)>& take);

// The same of whole maps; `normals`, if any, are as many.
std::size_t orthonormalise(DirectionMap& map, const SurfaceNormals* normals, bool in_plane);

}  // namespace burnish
