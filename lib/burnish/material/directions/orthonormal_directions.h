// Directions of anisotropy made orthonormal against bump normals (Isidoro & Brennan: T_new = T − (N·T) N, normalised).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "burnish/material/directions/direction_map.h"
#include "burnish/normal/coding.h"

namespace burnish {

// Bump normals of a whole map, in tangent space.
struct SurfaceNormals {
  int width = 0, height = 0;
  std::vector<Vec3f> vectors;  // unit
  float error = 0;             // as DirectionMap::error
  std::size_t invalid_texels = 0;
};

// kMalformed as NormalReader, and for a file that says its normals are in object space.
SurfaceNormals read_surface_normals(const FileRef& file, const NormalCoding& coding);

// Makes every vector unit, and orthogonal to its normal where there are normals, which are as many. Where it has no
// length, or is parallel to its normal, as far as the samples can tell, the texel takes the direction of the nearest
// one that is defined (then made orthogonal to its own normal) and is counted. With `in_plane` the result is turned
// into the plane of the map, where one that stands upright is not defined either. kMalformed where nothing is defined.
// In parallel, each texel by itself.
std::size_t orthonormalise(DirectionMap& map, const SurfaceNormals* normals, bool in_plane);

}  // namespace burnish
