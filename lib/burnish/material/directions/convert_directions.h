// One direction map made into another: read, turned, made orthonormal, written, all in bands of rows.
#pragma once

#include "burnish/material/directions/direction_map.h"
#include "burnish/material/directions/direction_turns.h"

namespace burnish {

struct DirectionSource {
  FileRef directions;
  DirectionCoding coding;
  DirectionTurns turns;
  FileRef normals;  // optional; they belong to what is written: they are not turned
  NormalCoding normal_coding;
};

struct DirectionTarget {
  FileRef file;
  FileType type = FileType::kPng;
  SampleType sample = SampleType::kUint8;
  DirectionCoding coding;  // not flow
};

struct DirectionStats {
  int width = 0, height = 0;
  std::size_t degenerate_texels = 0;      // took the direction of their nearest neighbour (orthonormal_directions.h)
  std::size_t invalid_normal_texels = 0;  // too short in the normal map: (0,0,1)
  // |N·T| of the vectors that a reader of the file gets, with the map's own N or (0,0,1).
  double max_abs_n_dot_t = 0;
};

// Without normals vectors keep their z. Strengths of khr are handed on. kMalformed where sizes differ; kUnsupported for
// what the target cannot hold; as DirectionReader, SurfaceNormalReader and orthonormal_bands().
DirectionStats convert_directions(const DirectionSource& from, const DirectionTarget& to);

}  // namespace burnish
