#include "burnish/mesh/bake/displaced_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "burnish/core/error.h"
#include "burnish/mesh/bake/map_rows.h"
#include "burnish/mesh/bake/uv_raster.h"
#include "burnish/normal/height_texels.h"
#include "burnish/normal/plane_fit.h"

namespace burnish {
namespace {

// A place on the mesh, and how it changes along u and v.
struct Surface {
  Vec3d normal;
  Vec3d p_u, p_v;  // of the position, in the plane of the normal
  Vec3d n_u, n_v;
};

// `a` and `b` are differences along the edges from the triangle's first corner.
struct Gradient {
  Vec2d edge_a, edge_b;
  double det;

  Vec3d along_u(Vec3d a, Vec3d b) const { return (a * edge_b.y - b * edge_a.y) / det; }
  Vec3d along_v(Vec3d a, Vec3d b) const { return (b * edge_a.x - a * edge_b.x) / det; }
};

Vec3d in_plane(Vec3d v, Vec3d normal) { return v - normal * dot(v, normal); }

Surface surface_at(const Mesh& mesh, const MeshPoint& point) {
  const std::uint32_t t = point.triangle;
  const Gradient gradient{mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0),
                          cross(mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0))};
  const Vec3d sum =
      mesh.normal(t, 0) * point.weight[0] + mesh.normal(t, 1) * point.weight[1] + mesh.normal(t, 2) * point.weight[2];
  const Vec3d pa = mesh.position(t, 1) - mesh.position(t, 0), pb = mesh.position(t, 2) - mesh.position(t, 0);
  const Vec3d na = mesh.normal(t, 1) - mesh.normal(t, 0), nb = mesh.normal(t, 2) - mesh.normal(t, 0);
  Surface s;
  s.normal = normal_at(mesh, point);
  if (gradient.det == 0) return s;
  s.p_u = in_plane(gradient.along_u(pa, pb), s.normal);
  s.p_v = in_plane(gradient.along_v(pa, pb), s.normal);
  if (const double size = length(sum); size > 1e-9) {  // where the corners' cancel out, normal_at has the triangle's
    s.n_u = in_plane(gradient.along_u(na, nb), s.normal) / size;
    s.n_v = in_plane(gradient.along_v(na, nb), s.normal) / size;
  }
  return s;
}

// `h` and its derivatives along u and v. Not of unit length where they are beyond floating point.
Vec3d displaced(const Surface& s, double h, double h_u, double h_v) {
  const Vec3d p_u = s.p_u + s.normal * h_u + s.n_u * h, p_v = s.p_v + s.normal * h_v + s.n_v * h;
  const Vec3d n = cross(p_u, p_v);
  const double size = length(n);
  if (size == 0) return s.normal;
  return dot(n, s.normal) < 0 ? -n / size : n / size;
}

struct RowStats {
  std::size_t covered = 0, overlapped = 0, degenerate = 0, taking_part = 0;
  double steepest = 0, tilt_sum = 0;
  bool too_steep = false;
  std::size_t first_broken = SIZE_MAX;  // texel whose height is not finite
  RowStats& operator+=(const RowStats& o) {
    covered += o.covered, overlapped += o.overlapped, degenerate += o.degenerate, taking_part += o.taking_part;
    steepest = std::max(steepest, o.steepest), tilt_sum += o.tilt_sum;
    too_steep = too_steep || o.too_steep;
    first_broken = std::min(first_broken, o.first_broken);
    return *this;
  }
};

class Displacer {
 public:
  Displacer(const Mesh& mesh, const HeightField& field, const HeightMapOptions& options)
      : mesh_(mesh),
        field_(field),
        heights_(field.heights),
        options_(options),
        neighborhood_(make_neighborhood(options.neighbors, options.weights)),
        raster_(mesh, heights_.width, heights_.height),
        charts_(uv_charts(mesh)),
        triangles_(heights_.texels()),
        takes_part_(heights_.width, heights_.height) {}

  // Which triangle each texel of a row lies on. All rows are placed before any is displaced.
  RowStats place(int y, std::uint8_t* covered) {
    std::uint32_t* triangles = triangles_.data() + std::size_t(y) * heights_.width;
    std::vector<std::uint8_t> several(heights_.width);
    raster_.row(y, triangles, several.data());
    RowStats stats;
    for (int x = 0; x < heights_.width; x++) {
      covered[x] = triangles[x] != UvRaster::kNone;
      const bool takes_part = covered[x] && (field_.mask.data.empty() || *field_.mask.at(x, y));
      *takes_part_.at(x, y) = takes_part;
      stats.covered += covered[x], stats.overlapped += several[x];
      if (takes_part && !std::isfinite(*heights_.at(x, y)))
        stats.first_broken = std::min(stats.first_broken, std::size_t(y) * heights_.width + x);
    }
    return stats;
  }

  RowStats displace(int y, Vec3f* normals) const {
    RowStats stats;
    for (int x = 0; x < heights_.width; x++) {
      const std::uint32_t t = triangles_[std::size_t(y) * heights_.width + x];
      if (t == UvRaster::kNone) continue;
      const MeshPoint point = raster_.point(t, x, y);
      if (!*takes_part_.at(x, y)) {
        normals[x] = Vec3f(normal_at(mesh_, point));
        continue;
      }
      const PlaneSlope slope = fit(x, y);
      stats.degenerate += !slope.determined;
      const Surface surface = surface_at(mesh_, point);
      const double h = options_.height * (*heights_.at(x, y) - options_.mid_level);
      const Vec3d n = displaced(surface, h, options_.height * heights_.width * slope.a0,
                                options_.height * heights_.height * slope.a1);
      const double tilt = angle_rad(n, surface.normal);
      stats.steepest = std::max(stats.steepest, tilt), stats.tilt_sum += tilt, stats.taking_part++;
      stats.too_steep = stats.too_steep || !(std::abs(length(n) - 1) < 1e-6);
      normals[x] = Vec3f(n);
    }
    return stats;
  }

 private:
  std::uint32_t chart_at(int x, int y) const { return charts_[triangles_[std::size_t(y) * heights_.width + x]]; }

  PlaneSlope fit(int x, int y) const {
    constexpr std::size_t kMostTaps = 81;
    float displacement[kMostTaps];
    bool exists[kMostTaps];
    const std::uint32_t chart = chart_at(x, y);
    for (std::size_t i = 0; i < neighborhood_.taps.size(); i++) {
      const int tx = wrapped_texel(x + neighborhood_.taps[i].x, heights_.width, options_.wrap_u);
      const int ty = wrapped_texel(y - neighborhood_.taps[i].y, heights_.height, options_.wrap_v);
      exists[i] = tx >= 0 && ty >= 0 && *takes_part_.at(tx, ty) && chart_at(tx, ty) == chart;
      displacement[i] = exists[i] ? *heights_.at(tx, ty) : 0.f;
    }
    return fit_plane(neighborhood_, displacement, exists);
  }

  const Mesh& mesh_;
  const HeightField& field_;
  const Image& heights_;
  const HeightMapOptions& options_;
  const Neighborhood neighborhood_;
  const UvRaster raster_;
  const std::vector<std::uint32_t> charts_;
  std::vector<std::uint32_t> triangles_;
  ByteImage takes_part_;
};

}  // namespace

HeightField read_height_field(const FileRef& file, const HeightMapOptions& options) {
  ImageReader reader(file);
  HeightChannel channel(reader, options.channel);
  HeightField field{reader.name(), Image(reader.width(), reader.height()), {}, false};
  std::vector<float> row(std::size_t(reader.width()) * reader.channels());
  for (int y = 0; y < reader.height(); y++) {
    reader.read_rows(y, 1, row.data());
    channel.take(row.data(), reader.width(), field.heights.row(y));
  }
  field.colour_channels_differ = channel.colours_differ();
  if (!options.mask.empty()) field.mask = read_mask(options.mask, reader.width(), reader.height());
  return field;
}

DisplacedNormals displaced_normals(Mesh mesh, const HeightField& field, const HeightMapOptions& options,
                                   const Progress& progress) {
  if (!std::isfinite(options.height)) throw Error(ErrorKind::kUsage, "height: expected a finite number");
  if (!std::isfinite(options.mid_level)) throw Error(ErrorKind::kUsage, "mid-level: expected a finite number");
  require_uvs(mesh, "which say where the map lies (burnish-simplify --atlas makes some)");
  require_atlas(mesh);
  add_smooth_normals(mesh);

  DisplacedNormals out;
  out.width = field.heights.width, out.height = field.heights.height;
  out.covered = ByteImage(out.width, out.height);
  out.normals.assign(field.heights.texels(), {0, 0, 1});
  Displacer displacer(mesh, field, options);
  RowStats stats = sum_of_rows<RowStats>(out.height, {}, [&](int y) { return displacer.place(y, out.covered.row(y)); });
  require_cover(mesh, stats.covered, out.width, out.height);
  if (stats.first_broken != SIZE_MAX)
    throw file_error(ErrorKind::kMalformed, field.name,
                     "expected finite heights, got NaN or infinity at column " +
                         std::to_string(stats.first_broken % out.width) + ", row " +
                         std::to_string(stats.first_broken / out.width) + " (--mask can exclude it)");
  stats += sum_of_rows<RowStats>(out.height, progress, [&](int y) {
    return displacer.displace(y, out.normals.data() + std::size_t(y) * out.width);
  });
  if (stats.too_steep)
    throw file_error(ErrorKind::kMalformed, field.name,
                     "slopes are too steep for floating point: look at the height, the mesh and the map");
  out.covered_texels = stats.covered, out.overlapped_texels = stats.overlapped;
  out.degenerate_texels = stats.degenerate;
  out.max_slope_deg = degrees(stats.steepest);
  out.mean_tilt_deg = stats.taking_part ? degrees(stats.tilt_sum / double(stats.taking_part)) : 0;
  return out;
}

}  // namespace burnish
