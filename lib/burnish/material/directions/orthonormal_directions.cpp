#include "burnish/material/directions/orthonormal_directions.h"

#include <algorithm>
#include <optional>

#include "burnish/brdf/local_frame.h"
#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/mesh/bake/gutter.h"
#include "burnish/normal/normal_space.h"

namespace burnish {
namespace {

// Three components that are each off by at most 1 are a vector shorter than that.
constexpr double kNoise = 1.75;

class Orthonormaliser {
 public:
  Orthonormaliser(const SurfaceNormals* normals, float error, bool in_plane)
      : normals_(normals), error_(error), in_plane_(in_plane) {}

  // None where it is not defined.
  std::optional<Vec3d> direction(std::size_t i, Vec3d t) const {
    const double noise = kNoise * (error_ + (normals_ ? normals_->error * length(t) : 0));
    const Vec3d across = normals_ ? t - normal(i) * dot(normal(i), t) : t;
    if (!(length(across) > noise)) return std::nullopt;
    Vec3d d = normalized(t);
    if (normals_) {
      const std::optional<LocalFrame> frame = orthonormal_frame(normal(i), t);
      if (!frame) return std::nullopt;
      d = frame->t;
    }
    if (!in_plane_) return d;
    d.z = 0;
    if (!(length(d) > 1e-6)) return std::nullopt;
    return normalized(d);
  }

  // For a texel whose own direction is not defined, from that of another.
  Vec3d direction_from(std::size_t i, std::size_t source, Vec3d t) const {
    if (const std::optional<Vec3d> d = direction(i, t)) return *d;
    if (in_plane_) return t;
    // The source's direction is this texel's normal: turned as its normal turns into ours, it is its normal.
    return orthonormal_frame(normal(i), normal(source) * -dot(normal(i), t))->t;
  }

 private:
  Vec3d normal(std::size_t i) const { return Vec3d(normals_->vectors[i]); }

  const SurfaceNormals* normals_;
  double error_;
  bool in_plane_;
};

}  // namespace

SurfaceNormals read_surface_normals(const FileRef& file, const NormalCoding& coding) {
  NormalReader reader(file, coding);
  if (recorded_space(reader.image()) == NormalSpace::kObject)
    throw file_error(ErrorKind::kMalformed, file.name, "expected normals in tangent space, got object space");
  SurfaceNormals normals{reader.width(), reader.height(), reader.read_all(), 0, 0};
  normals.invalid_texels = reader.invalid_texels();
  normals.error = rounding_error(reader.image().sample_type());
  return normals;
}

std::size_t orthonormalise(DirectionMap& map, const SurfaceNormals* normals, bool in_plane) {
  const Orthonormaliser with(normals, map.error, in_plane);
  ByteImage defined(map.width, map.height);
  parallel_for(map.height, [&](std::size_t y) {
    for (std::size_t i = y * map.width; i < (y + 1) * map.width; i++) {
      const std::optional<Vec3d> d = with.direction(i, Vec3d(map.vectors[i]));
      defined.data[i] = d.has_value();
      if (d) map.vectors[i] = Vec3f(*d);
    }
  });
  const std::size_t degenerate = std::size_t(std::ranges::count(defined.data, 0));
  if (degenerate == 0) return 0;
  if (degenerate == defined.texels())
    throw file_error(ErrorKind::kMalformed, map.name,
                     std::string("expected directions, got none of any length") +
                         (normals ? " that is not parallel to its normal" : ""));
  const std::vector<std::uint32_t> sources = gutter_sources(defined, map.width + map.height);
  parallel_for(map.height, [&](std::size_t y) {
    for (std::size_t i = y * map.width; i < (y + 1) * map.width; i++)
      if (!defined.data[i]) map.vectors[i] = Vec3f(with.direction_from(i, sources[i], Vec3d(map.vectors[sources[i]])));
  });
  return degenerate;
}

}  // namespace burnish
