#include "burnish/material/directions/orthonormal_directions.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "burnish/brdf/local_frame.h"
#include "burnish/core/band_rows.h"
#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/whole_image.h"
#include "burnish/material/directions/nearest_directions.h"
#include "burnish/normal/normal_space.h"

namespace burnish {
namespace {

// Three components that are each off by at most 1 are a vector shorter than that.
constexpr double kNoise = 1.75;

// Of the texels of a band.
class Orthonormaliser {
 public:
  Orthonormaliser(const DirectionBand& band, bool in_plane)
      : normals_(band.normals ? &*band.normals : nullptr), error_(band.map.error), in_plane_(in_plane) {}

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

  // For a texel whose own direction is not defined, from another.
  Vec3d direction_from(std::size_t i, const NearestDirections::Texel& source) const {
    const Vec3d t(source.t);
    if (const std::optional<Vec3d> d = direction(i, t)) return *d;
    if (in_plane_) return t;
    // The source's direction is this texel's normal: turned as its normal turns into ours, it is its normal.
    return orthonormal_frame(normal(i), Vec3d(source.n) * -dot(normal(i), t))->t;
  }

 private:
  Vec3d normal(std::size_t i) const { return Vec3d(normals_->vectors[i]); }

  const SurfaceNormals* normals_;
  double error_;
  bool in_plane_;
};

// A band's directions made orthonormal where they are defined.
struct OrthonormalBand {
  DirectionBand band;
  std::vector<std::uint8_t> defined;

  OrthonormalBand(DirectionBand&& from, bool in_plane) : band(std::move(from)), defined(band.map.vectors.size()) {
    const Orthonormaliser with(band, in_plane);
    parallel_for(std::size_t(band.map.height), [&](std::size_t y) {
      for (std::size_t i = y * band.map.width; i < (y + 1) * band.map.width; i++) {
        const std::optional<Vec3d> d = with.direction(i, Vec3d(band.map.vectors[i]));
        defined[i] = d.has_value();
        if (d) band.map.vectors[i] = Vec3f(*d);
      }
    });
  }
  DirectionRow row(int y) const {
    const std::size_t at = std::size_t(y) * band.map.width;
    return {&defined[at], &band.map.vectors[at], band.normals ? &band.normals->vectors[at] : nullptr};
  }
};

// The last row of the band before.
struct RowAbove {
  std::vector<Vec3f> t, n;

  void keep(const DirectionBand& band) {
    const auto last = [&](const std::vector<Vec3f>& of) { return std::vector(of.end() - band.map.width, of.end()); };
    t = last(band.map.vectors);
    if (band.normals) n = last(band.normals->vectors);
  }
  DirectionRow row() const { return {nullptr, t.data(), n.empty() ? nullptr : n.data()}; }
};

// What is missing in rows from `first` on.
void fill(OrthonormalBand& to, int first, const RowAbove& before, NearestDirections& directions, bool in_plane) {
  const Orthonormaliser with(to.band, in_plane);
  const int width = to.band.map.width;
  std::vector<Vec3f> filled(width);
  for (int y = 0; y < to.band.map.height; y++) {
    const DirectionRow row = to.row(y), above = y > 0 ? to.row(y - 1) : before.row();
    directions.enter(first + y, row, first + y > 0 ? &above : nullptr);
    if (std::ranges::count(row.defined, row.defined + width, 0) == 0) continue;
    const std::size_t at = std::size_t(y) * width;
    parallel_for_chunks(std::size_t(width), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t x = begin; x < end; x++)
        if (!row.defined[x]) filled[x] = Vec3f(with.direction_from(at + x, directions.nearest(int(x))));
    });
    for (int x = 0; x < width; x++)
      if (!row.defined[x]) to.band.map.vectors[at + x] = filled[x];
  }
}

}  // namespace

SurfaceNormalReader::SurfaceNormalReader(const FileRef& file, const NormalCoding& coding) : reader_(file, coding) {
  if (recorded_space(reader_.image()) == NormalSpace::kObject)
    throw file_error(ErrorKind::kMalformed, file.name, "expected normals in tangent space, got object space");
}

SurfaceNormals SurfaceNormalReader::rows(int first, int count) {
  const std::size_t before = reader_.invalid_texels();
  SurfaceNormals normals{width(), count, {}, rounding_error(reader_.image().sample_type()), 0};
  normals.vectors = read_whole<Vec3f>(reader_.name(), count, std::size_t(width()), [&](int row, int some, Vec3f* out) {
    reader_.read_rows(first + row, some, out);
  });
  normals.invalid_texels = reader_.invalid_texels() - before;
  return normals;
}

SurfaceNormals read_surface_normals(const FileRef& file, const NormalCoding& coding) {
  SurfaceNormalReader reader(file, coding);
  return reader.rows(0, reader.height());
}

std::size_t orthonormal_bands(int width, int height, bool in_plane, const std::string& directory,
                              const std::function<DirectionBand(int, int)>& read,
                              const std::function<void(DirectionBand&)>& take) {
  const int at_once = band_rows(width);
  const auto rows_at = [&](int y) { return std::min(at_once, height - y); };
  NearestDirections directions(width, directory);
  RowAbove above;
  int taken = 0;
  std::string name;
  bool with_normals = false;
  for (int y = 0; y < height; y += at_once) {
    OrthonormalBand band(read(y, rows_at(y)), in_plane);
    for (int row = 0; row < band.band.map.height; row++) directions.note(band.row(row));
    if (directions.missing() == 0) {
      above.keep(band.band);
      take(band.band);
      taken = y + rows_at(y);
    }
    name = band.band.map.name, with_normals = band.band.normals.has_value();
  }
  if (directions.missing() == std::size_t(width) * height)
    throw file_error(ErrorKind::kMalformed, name,
                     std::string("expected directions, got none of any length") +
                         (with_normals ? " that is not parallel to its normal" : ""));
  directions.end_notes();
  for (int y = taken; y < height; y += at_once) {
    OrthonormalBand band(read(y, rows_at(y)), in_plane);
    fill(band, y, above, directions, in_plane);
    above.keep(band.band);
    take(band.band);
  }
  return directions.missing();
}

std::size_t orthonormalise(DirectionMap& map, const SurfaceNormals* normals, bool in_plane) {
  const auto slice = [&](const auto& of, int first, int count) {
    return std::vector(of.begin() + std::size_t(first) * map.width,
                       of.begin() + std::size_t(first + count) * map.width);
  };
  const auto read = [&](int first, int count) {
    DirectionBand band{{map.name, map.width, count, slice(map.vectors, first, count), map.error, {}}, std::nullopt};
    if (normals) band.normals = {map.width, count, slice(normals->vectors, first, count), normals->error, 0};
    return band;
  };
  std::size_t taken = 0;
  const auto take = [&](const DirectionBand& band) {
    std::ranges::copy(band.map.vectors, map.vectors.begin() + taken);
    taken += band.map.vectors.size();
  };
  return orthonormal_bands(map.width, map.height, in_plane, std::filesystem::temp_directory_path().string(), read,
                           take);
}

}  // namespace burnish
