// Tangent frames of a mesh at its corners, as MikkTSpace defines them (Mikkelsen, "Simulation of wrinkled surfaces
// revisited", 2008, and the standard implementation's grouping of corners).
//
// A corner's tangent is the direction of +u in the plane of its normal, averaged by angle over the triangles of its
// group: those around the vertex that share position, normal, texture coordinates and handedness across their edges.
// The bitangent is sign · n × t, and lies along +v; sign is −1 where the texture is mirrored. Between corners vectors
// are interpolated and not renormalised; a mapped normal (x, y, z) is then normalise(x·t + y·b + z·n).
#pragma once

#include <array>
#include <vector>

#include "burnish/mesh/mesh.h"

namespace burnish {

struct CornerTangent {
  Vec3d tangent;  // unit, perpendicular to the corner's normal
  double sign = 1;
};
using TangentFrames = std::vector<std::array<CornerTangent, 3>>;  // one a triangle

// The mesh has normals and texture coordinates. A triangle without texture area takes the frame of a neighbour at its
// corners, or else any right-handed one.
TangentFrames tangent_frames(const Mesh& mesh);

// Between the corners; t, b and n as a shader interpolates them.
struct FrameAt {
  Vec3d t, b, n;

  Vec3d to_object(Vec3d mapped) const { return normalized(t * mapped.x + b * mapped.y + n * mapped.z); }
  // The tangent-space vector that to_object takes to `object`.
  Vec3d to_tangent(Vec3d object) const;
};
FrameAt frame_at(const Mesh& mesh, const TangentFrames& frames, const MeshPoint& point);

}  // namespace burnish
