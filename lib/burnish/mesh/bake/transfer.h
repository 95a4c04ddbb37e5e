// Detail of one mesh into maps over the texture coordinates of a coarser one: normals, displacement, coverage.
//
// Each texel is sampled at samples × samples places; those of one chart that find a point of the detailed mesh (see
// transfer_search.h) are averaged. Rays start on the coarse mesh; its smooth normals, along which they run, leave no
// gaps at hard edges: positions alone make them, whatever normals the file has. Normals that are written are the
// detailed mesh's own, or smooth ones where it has none.
//
// A texel is covered where any of its places lies in a triangle; of several triangles the smallest index counts. Memory
// holds whole maps, about 40 bytes a texel. Runs in parallel over rows, each on its own; sums are added row by row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

enum class RayDirection {
  kSmooth,   // along the smooth normal: continuous, and what displacement maps are displaced along
  kHalfway,  // between that and the triangle's own, round which the directions lie that it is seen from: detail stands
             // nearer to where a viewer sees it, in return for small steps at edges
};

struct TransferOptions {
  int width = 1024, height = 1024;
  NormalSpace space = NormalSpace::kObject;  // tangent: of the coarse mesh (tangent_frames.h)
  RayDirection rays = RayDirection::kSmooth;
  std::optional<double> max_distance;  // default: kMaxDistanceShare of the detailed mesh's diagonal
  std::optional<double> cage;          // outwards; default: max_distance
  int samples = 2;                     // 1 to 16
  int padding = 16;                    // texels; 0: none

  static constexpr double kMaxDistanceShare = 0.1;
};

enum Coverage : std::uint8_t { kUncovered, kMissed, kFound };

struct TransferMaps {
  int width = 0, height = 0;
  std::vector<Vec3f> normals;  // unit; (0,0,1) beyond the gutters
  Image displacement;          // along the rays, outwards positive; 0 beyond the gutters
  ByteImage coverage;          // a Coverage each; no gutters

  std::size_t covered_texels = 0;
  std::size_t missed_texels = 0;      // covered, and found nothing: they hold the coarse mesh's own normal
  std::size_t overlapped_texels = 0;  // with a place that several triangles cover
  double max_distance = 0;            // between a place and the point that was found for it; never beyond the options'
};

// kMalformed where `coarse` has no texture coordinates, has some outside [0,1], or covers no texel, or where no texel
// finds anything; kUsage for sizes, samples, padding or distances out of range.
TransferMaps transfer_detail(Mesh coarse, Mesh detailed, const TransferOptions& options, const Progress& progress = {});

}  // namespace burnish
