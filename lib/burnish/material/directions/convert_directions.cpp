#include "burnish/material/directions/convert_directions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/core/shared_size.h"
#include "burnish/material/directions/orthonormal_directions.h"

namespace burnish {
namespace {

double max_abs_n_dot_t(const DirectionMap& map, const SurfaceNormals* normals) {
  double most = 0;
  for (std::size_t i = 0; i < map.vectors.size(); i++) {
    const Vec3d n = normals ? Vec3d(normals->vectors[i]) : Vec3d{0, 0, 1};
    most = std::max(most, std::abs(dot(n, normalized(Vec3d(map.vectors[i])))));
  }
  return most;
}

}  // namespace

DirectionStats convert_directions(const DirectionSource& from, const DirectionTarget& to) {
  require_encodable(to.coding, to.sample, to.file.name);
  DirectionMap map = turned(read_direction_map(from.directions, from.coding), from.turns);
  std::optional<SurfaceNormals> normals;
  if (!from.normals.empty()) {
    normals = read_surface_normals(from.normals, from.normal_coding);
    SharedSize{map.width, map.height, map.name}.take(normals->width, normals->height, from.normals.name);
  }
  const SurfaceNormals* n = normals ? &*normals : nullptr;
  DirectionStats stats{map.width, map.height};
  if (n) stats.invalid_normal_texels = n->invalid_texels;
  stats.degenerate_texels = orthonormalise(map, n, to.coding.form != DirectionForm::kVector);

  const Image samples = encode_directions(map, to.coding, to.sample);
  stats.max_abs_n_dot_t = max_abs_n_dot_t(decode_directions(to.file.name, samples, to.coding, to.sample), n);
  write_image(to.file, to.type, to.sample, samples, direction_attributes(to.coding.form));
  return stats;
}

}  // namespace burnish
