// Displacement map over a mesh's texture coordinates to object-space normals (Tarini et al., section 4.1, whose plane
// is "translated on the real world system").
//
// The surface is P(u, v) = S + h·N, with S the mesh, N its interpolated unit normal and h = height · (value −
// mid_level) in the mesh's units. At a texel's centre
//   P_u = S_u + h_u·N + h·N_u,   P_v = S_v + h_v·N + h·N_v,   n = ± P_u × P_v / ‖·‖, the sign that of N
// where h_u = height·W·a₀ and h_v = height·H·a₁ come from the plane fit of plane_fit.h over a W×H map; S_u and S_v, per
// unit of u and v, from the triangle's corners, brought into the plane of N as tangent frames are, so that h = 0 gives
// the smooth normal and not a facet (heights are measured from the smooth surface that the mesh stands for); N_u and
// N_v from the corners' normals. Where N bends little this is the tangent-space normal of burnish-normals with --size
// ‖S_u‖×‖S_v‖, in the frame along S_u, S_v and N: one size for all where the map is isometric. On a torus of radii 1
// and 0.4, at slopes of up to 34° and lit by Lambert, that is 50 dB with each texel's own size and 34 dB with one for
// all.
//
// Texels whose centre no triangle covers are gutters. To a fit only texels of one chart belong (uv_raster.h), beside
// what wrap and mask allow. Runs in parallel over rows, each on its own. Memory holds the whole map, about 40 bytes a
// texel.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/progress.h"
#include "burnish/mesh/mesh.h"
#include "burnish/normal/height_map.h"

namespace burnish {

struct DisplacedNormals {
  int width = 0, height = 0;
  std::vector<Vec3f> normals;  // unit; (0,0,1) where nothing is covered
  ByteImage covered;           // 1 where a texel has a place on the mesh
  std::size_t covered_texels = 0;
  std::size_t overlapped_texels = 0;  // that several triangles cover: the first counts
  std::size_t degenerate_texels = 0;  // too few usable points for a plane: they hold N, as those that the mask excludes
  double max_slope_deg = 0;           // steepest angle between n and N
  double mean_tilt_deg = 0;           // its mean over the covered texels that take part
};

// A displacement map, whole.
struct HeightField {
  std::string name;                     // of the file, for messages
  Image heights;                        // one channel
  ByteImage mask;                       // empty: every texel takes part; otherwise those where it is not 0
  bool colour_channels_differ = false;  // and none was chosen
};
// Channel and mask by the options. kMalformed for a mask of another size and for a channel the file does not have.
HeightField read_height_field(const FileRef& file, const HeightMapOptions& options);

// kMalformed where the mesh has no texture coordinates or some outside [0,1], where it covers no texel, for a height
// that takes part and is not finite, and for slopes beyond floating point; kUsage as convert_height_map. Of the options
// sizes, channel and mask are not used.
DisplacedNormals displaced_normals(Mesh mesh, const HeightField& field, const HeightMapOptions& options,
                                   const Progress& progress = {});

}  // namespace burnish
