#include "burnish/mesh/bake/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/mesh/bake/gutter.h"
#include "burnish/mesh/bake/map_rows.h"
#include "burnish/mesh/bake/transfer_search.h"
#include "burnish/mesh/bake/uv_raster.h"
#include "burnish/mesh/tangent_frames.h"

namespace burnish {
namespace {

constexpr int kMostSamples = 16, kMostPadding = 1 << 16;

void require_range(const std::string& what, int value, int least, int most) {
  if (value < least || value > most)
    throw Error(ErrorKind::kUsage, what + ": expected " + std::to_string(least) + " to " + std::to_string(most) +
                                       ", got " + std::to_string(value));
}

double checked_distance(const std::string& what, double value) {
  if (!(value >= 0 && std::isfinite(value)))
    throw Error(ErrorKind::kUsage, what + ": expected a number of at least 0, got " + std::to_string(value));
  return value;
}

TransferReach reach_of(const TransferOptions& options, const Mesh& detailed) {
  TransferReach reach;
  reach.max_distance = checked_distance(
      "max-distance", options.max_distance.value_or(TransferOptions::kMaxDistanceShare * bounds(detailed).diagonal()));
  reach.cage = checked_distance("cage", options.cage.value_or(reach.max_distance));
  return reach;
}

Error nothing_found(const Mesh& coarse, const Mesh& detailed, const TransferReach& reach) {
  const auto outwards = reach.cage == reach.max_distance ? "" : " (outwards " + number_text(float(reach.cage)) + ")";
  return file_error(ErrorKind::kMalformed, detailed.name,
                    "expected a surface within " + number_text(float(reach.max_distance)) + outwards + " of '" +
                        coarse.name +
                        "' that faces the same way, got none at any texel: are both at the same place "
                        "and scale? (--max-distance and --cage say how far)");
}

Mesh with_smooth_normals(Mesh mesh) {
  mesh.normals.clear(), mesh.triangle_normals.clear();
  add_smooth_normals(mesh);
  return mesh;
}

struct RowStats {
  std::size_t covered = 0, missed = 0, overlapped = 0;
  double max_distance = 0;
  RowStats& operator+=(const RowStats& o) {
    covered += o.covered, missed += o.missed, overlapped += o.overlapped;
    max_distance = std::max(max_distance, o.max_distance);
    return *this;
  }
};

class Transfer {
 public:
  Transfer(const Mesh& coarse, const Mesh& detailed, const TransferOptions& options, TransferMaps& maps)
      : coarse_(coarse),
        detailed_(detailed),
        options_(options),
        smooth_(with_smooth_normals(coarse)),
        reach_(reach_of(options, detailed)),
        search_(detailed, reach_),
        raster_(coarse, options.width * options.samples, options.height * options.samples),
        charts_(uv_charts(coarse)),
        maps_(maps) {
    if (options.space == NormalSpace::kTangent) frames_ = tangent_frames(coarse);
  }

  const TransferReach& reach() const { return reach_; }

  RowStats row(int y) const {
    const std::size_t n = options_.samples, width = n * options_.width;
    Places places{std::vector<std::uint32_t>(n * width), std::vector<std::uint8_t>(n * width)};
    for (std::size_t j = 0; j < n; j++)
      raster_.row(int(y * n + j), places.triangles.data() + j * width, places.several.data() + j * width);
    RowStats stats;
    for (int x = 0; x < options_.width; x++) texel(x, y, places, stats);
    return stats;
  }

 private:
  // Where a row of texels is sampled, row by row.
  struct Places {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint8_t> several;
  };

  void texel(int x, int y, const Places& places, RowStats& stats) const {
    const int n = options_.samples;
    const auto index = [&](int i, int j) { return (std::size_t(j) * options_.width + x) * n + i; };
    std::uint32_t first = UvRaster::kNone;
    bool several = false;
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++) {
        first = std::min(first, places.triangles[index(i, j)]);
        several = several || places.several[index(i, j)];
      }
    if (first == UvRaster::kNone) return;

    Vec3d normal, own;
    double displacement = 0;
    int found = 0;
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++) {
        const std::uint32_t t = places.triangles[index(i, j)];
        if (t == UvRaster::kNone || charts_[t] != charts_[first]) continue;
        const MeshPoint place = raster_.point(t, x * n + i, y * n + j);
        own += in_space(place, normal_at(coarse_, place));
        const Vec3d direction = ray_direction(place);
        const std::optional<Detail> detail = search_.find(position_at(coarse_, place), direction);
        if (!detail) continue;
        normal += in_space(place, normal_at(detailed_, detail->point));
        displacement += dot(detail->offset, direction);
        stats.max_distance = std::max(stats.max_distance, detail->distance);
        found++;
      }
    const std::size_t at = std::size_t(y) * options_.width + x;
    stats.covered++;
    stats.missed += found == 0;
    stats.overlapped += several;
    maps_.coverage.data[at] = found ? kFound : kMissed;
    if (length(normal) < 1e-6) normal = own;  // missed, or opposing normals that cancel out
    maps_.normals[at] = length(normal) < 1e-6 ? Vec3f{0, 0, 1} : Vec3f(normalized(normal));
    maps_.displacement.data[at] = found ? float(displacement / found) : 0.f;
  }

  Vec3d in_space(const MeshPoint& place, Vec3d object) const {
    if (options_.space == NormalSpace::kObject) return object;
    return frame_at(coarse_, frames_, place).to_tangent(object);
  }

  Vec3d ray_direction(const MeshPoint& place) const {
    const Vec3d smooth = normal_at(smooth_, place), face = coarse_.perpendicular(place.triangle);
    if (options_.rays == RayDirection::kSmooth || !(length(face) > 0)) return smooth;
    const Vec3d halfway = smooth + normalized(face);
    return length(halfway) > 1e-6 ? normalized(halfway) : smooth;
  }

  const Mesh &coarse_, &detailed_;
  const TransferOptions& options_;
  const Mesh smooth_;
  const TransferReach reach_;
  const DetailSearch search_;
  const UvRaster raster_;
  const std::vector<std::uint32_t> charts_;
  TangentFrames frames_;
  TransferMaps& maps_;
};

}  // namespace

TransferMaps transfer_detail(Mesh coarse, Mesh detailed, const TransferOptions& options, const Progress& progress) {
  require_range("samples", options.samples, 1, kMostSamples);
  require_range("padding", options.padding, 0, kMostPadding);
  const int most = UvRaster::kMostTexels / options.samples;
  require_range("size", options.width, 1, most), require_range("size", options.height, 1, most);
  constexpr std::int64_t kMostInAll = std::int64_t(1) << 30;
  if (std::int64_t(options.width) * options.height > kMostInAll)
    throw Error(ErrorKind::kUsage, "size: expected at most 2^30 texels in all (32768x32768), got " +
                                       std::to_string(options.width) + "x" + std::to_string(options.height));
  require_uvs(coarse, "which place the detail in a map (burnish-simplify --atlas makes some)");
  require_atlas(coarse);
  add_smooth_normals(coarse), add_smooth_normals(detailed);

  TransferMaps maps;
  maps.width = options.width, maps.height = options.height;
  maps.coverage = ByteImage(maps.width, maps.height);
  maps.normals.assign(maps.coverage.texels(), {0, 0, 1});
  maps.displacement = Image(maps.width, maps.height);
  const Transfer transfer(coarse, detailed, options, maps);
  const auto stats = sum_of_rows<RowStats>(maps.height, progress, [&](int y) { return transfer.row(y); });
  maps.covered_texels = stats.covered, maps.missed_texels = stats.missed;
  maps.overlapped_texels = stats.overlapped, maps.max_distance = stats.max_distance;
  require_cover(coarse, stats.covered, maps.width, maps.height);
  if (stats.missed == stats.covered) throw nothing_found(coarse, detailed, transfer.reach());
  const std::vector<std::uint32_t> sources = gutter_sources(maps.coverage, options.padding);
  fill_gutter(sources, maps.normals);
  fill_gutter(sources, maps.displacement.data);
  return maps;
}

}  // namespace burnish
