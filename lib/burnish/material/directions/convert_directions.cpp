#include "burnish/material/directions/convert_directions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "burnish/core/parallel.h"
#include "burnish/core/shared_size.h"
#include "burnish/material/directions/orthonormal_directions.h"
#include "burnish/material/directions/turned_directions.h"

namespace burnish {
namespace {

double max_abs_n_dot_t(const DirectionMap& map, const std::optional<SurfaceNormals>& normals) {
  std::vector<double> most(map.height);
  parallel_for(std::size_t(map.height), [&](std::size_t y) {
    for (std::size_t i = y * map.width; i < (y + 1) * map.width; i++) {
      const Vec3d n = normals ? Vec3d(normals->vectors[i]) : Vec3d{0, 0, 1};
      most[y] = std::max(most[y], std::abs(dot(n, normalized(Vec3d(map.vectors[i])))));
    }
  });
  return std::ranges::max(most);
}

}  // namespace

DirectionStats convert_directions(const DirectionSource& from, const DirectionTarget& to) {
  require_encodable(to.coding, to.sample, to.file.name);
  const std::string directory = std::filesystem::path(to.file.path).parent_path().string();
  TurnedDirections directions(from.directions, from.coding, from.turns, directory);
  DirectionStats stats{directions.width(), directions.height()};
  std::optional<SurfaceNormalReader> normals;
  if (!from.normals.empty()) {
    normals.emplace(from.normals, from.normal_coding);
    SharedSize{stats.width, stats.height, directions.name()}.take(normals->width(), normals->height(),
                                                                  from.normals.name);
  }
  ImageWriter writer(to.file, to.type, to.sample, stats.width, stats.height, channels_of(to.coding.form),
                     direction_attributes(to.coding.form));
  const auto read = [&](int first, int count) {
    DirectionBand band{directions.rows(first, count), std::nullopt};
    if (normals) band.normals = normals->rows(first, count);
    return band;
  };
  const auto take = [&](const DirectionBand& band) {
    const Image samples = encode_directions(band.map, to.coding, to.sample);
    const DirectionMap written = decode_directions(to.file.name, samples, to.coding, to.sample);
    stats.max_abs_n_dot_t = std::max(stats.max_abs_n_dot_t, max_abs_n_dot_t(written, band.normals));
    if (band.normals) stats.invalid_normal_texels += band.normals->invalid_texels;
    writer.write_rows(samples.height, samples.data.data());
  };
  const bool in_plane = to.coding.form != DirectionForm::kVector;
  stats.degenerate_texels = orthonormal_bands(stats.width, stats.height, in_plane, directory, read, take);
  writer.close();
  return stats;
}

}  // namespace burnish
