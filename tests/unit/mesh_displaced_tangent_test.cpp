#include <gtest/gtest.h>

#include <cmath>

#include "burnish/mesh/bake/uv_raster.h"
#include "burnish/mesh/tangent_frames.h"
#include "mesh_displaced_normals_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

// The tangent-space map of burnish-normals for a map of this extent.
std::vector<Vec3f> tangent_space(const HeightField& field, HeightMapOptions options, double size_u, double size_v) {
  const ScratchDir dir;
  options.size_u = size_u, options.size_v = size_v;
  write_image(dir / "h.exr", FileType::kExr, SampleType::kFloat, field.heights);
  if (!field.mask.data.empty()) {
    Image mask(field.mask.width, field.mask.height);
    for (std::size_t i = 0; i < mask.data.size(); i++) mask.data[i] = field.mask.data[i];
    write_image(dir / "m.exr", FileType::kExr, SampleType::kFloat, mask);
    options.mask = FileRef(dir / "m.exr");
  }
  const NormalMapTarget target{dir / "n.exr", FileType::kExr, SampleType::kFloat, {}};
  convert_height_map(dir / "h.exr", options, target);
  int w, h;
  return read_normals(dir / "n.exr", {}, &w, &h);
}

struct Difference {
  double worst_deg = 0, mean_square_light = 0;
};

// Between the object-space map and a tangent-space map in the mesh's frames, over the covered texels; lit by Lambert.
Difference from_tangent_space(Mesh mesh, const DisplacedNormals& object, const std::vector<Vec3f>& tangent) {
  add_smooth_normals(mesh);
  const TangentFrames frames = tangent_frames(mesh);
  const UvRaster raster(mesh, object.width, object.height);
  std::vector<std::uint32_t> triangles(object.width);
  std::vector<std::uint8_t> several(object.width);
  const Vec3d light = normalized(Vec3d{1, 2, 3});
  Difference d;
  std::size_t count = 0;
  for (int y = 0; y < object.height; y++) {
    raster.row(y, triangles.data(), several.data());
    for (int x = 0; x < object.width; x++) {
      if (triangles[x] == UvRaster::kNone) continue;
      const FrameAt frame = frame_at(mesh, frames, raster.point(triangles[x], x, y));
      const Vec3d a = normal_of(object, x, y), b = frame.to_object(Vec3d(tangent[std::size_t(y) * object.width + x]));
      d.worst_deg = std::max(d.worst_deg, degrees(angle_rad(a, b)));
      d.mean_square_light += std::pow(std::max(0.0, dot(a, light)) - std::max(0.0, dot(b, light)), 2), count++;
    }
  }
  d.mean_square_light /= double(count);
  return d;
}

TEST(DisplacedNormals, OnAFlatSheetTheyAreTheTangentSpaceOnes) {
  HeightField field = field_of(40, 24, waves);
  for (const bool masked : {false, true}) {
    if (masked) {
      field.mask = ByteImage(40, 24);
      for (std::size_t i = 0; i < field.mask.data.size(); i++) field.mask.data[i] = i % 7 != 0 && i % 40 != 13;
    }
    for (const int neighbors : {4, 8, 80})
      for (const Wrap wrap : {Wrap::kFit, Wrap::kClamp, Wrap::kRepeat, Wrap::kMirror})
        for (const FitWeights weights : {FitWeights::kUniform, FitWeights::kGaussian}) {
          HeightMapOptions options = with_height(0.3);
          options.neighbors = neighbors, options.weights = weights, options.mid_level = 0.4;
          options.wrap_u = wrap, options.wrap_v = wrap;
          const DisplacedNormals object = displaced_normals(sheet(kA, kB), field, options);
          const Difference d =
              from_tangent_space(sheet(kA, kB), object, tangent_space(field, options, length(kA), length(kB)));
          EXPECT_LT(d.worst_deg, 1e-4) << neighbors << " neighbors, wrap " << int(wrap) << (masked ? ", masked" : "");
        }
  }
}

TEST(DisplacedNormals, InAMirroredMapToo) {
  const auto mirrored = [](double u, double v) { return Vec2d{1 - u, v}; };
  const HeightField field = field_of(32, 32, waves);
  const HeightMapOptions options = with_height(0.2);
  const DisplacedNormals object = displaced_normals(sheet(kA, kB, mirrored), field, options);
  const std::vector<Vec3f> tangent = tangent_space(field, options, length(kA), length(kB));
  EXPECT_LT(from_tangent_space(sheet(kA, kB, mirrored), object, tangent).worst_deg, 1e-4);
  // What rises along u falls along kA here.
  const HeightField ramp = field_of(32, 32, [](double u, double) { return u; });
  const Vec3d n = normal_of(displaced_normals(sheet(kA, kB, mirrored), ramp, options), 16, 16);
  EXPECT_GT(dot(n, kA), 0.05);
  EXPECT_GT(dot(n, cross(kA, kB)), 0);
}

// The same displacement by either way, lit: more than 45 dB wherever the map's size is that of the surface. One size
// for all fits a map that is isometric, or nearly so.
HeightField ripples() {
  return field_of(512, 256, [](double u, double v) {
    return std::sin(16 * kPi * u) * std::cos(10 * kPi * v) + 0.4 * std::sin(34 * kPi * u + 20 * kPi * v);
  });
}
double lit_db(const Difference& d) { return -10 * std::log10(d.mean_square_light); }

TEST(DisplacedNormals, ObjectSpaceIsTangentSpaceInTheFramesOfAnIsometricMap) {
  const HeightField field = ripples();
  HeightMapOptions options = with_height(0.01);  // slopes of up to 25° and more
  options.wrap_u = Wrap::kRepeat;
  const DisplacedNormals object = displaced_normals(tube(64), field, options);
  EXPECT_GT(object.max_slope_deg, 25);
  EXPECT_GT(lit_db(from_tangent_space(tube(64), object, tangent_space(field, options, 2, 1))), 45);
}

TEST(DisplacedNormals, ObjectSpaceIsTangentSpaceOnAPatchThatBendsBothWays) {
  const Mesh patch = grid_mesh(
      64, 32,
      [](double u, double v) {  // of the unit sphere, about its equator
        const double a = 0.5 * (u - 0.5), b = 0.25 * (v - 0.5);
        return Vec3d{std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)};
      },
      identity_uv);
  const HeightField field = ripples();
  const HeightMapOptions options = with_height(0.0025);
  const DisplacedNormals object = displaced_normals(patch, field, options);
  EXPECT_GT(object.max_slope_deg, 25);
  EXPECT_GT(lit_db(from_tangent_space(patch, object, tangent_space(field, options, 0.5, 0.25))), 65);
}

TEST(DisplacedNormals, ObjectSpaceIsTangentSpaceOfEachTexelsOwnSize) {
  const Mesh ring = grid_mesh(128, 64, torus, identity_uv);
  const HeightField field = ripples();
  HeightMapOptions options = with_height(0.025);
  options.wrap_u = options.wrap_v = Wrap::kRepeat;
  const DisplacedNormals object = displaced_normals(ring, field, options);
  EXPECT_GT(object.max_slope_deg, 25);
  std::vector<Vec3f> tangent = tangent_space(field, options, 2 * kPi, 2 * kPi * 0.4);
  EXPECT_LT(lit_db(from_tangent_space(ring, object, tangent)), 40) << "the torus is wider outside than inside";
  for (int y = 0; y < object.height; y++)
    for (int x = 0; x < object.width; x++) {
      Vec3f& n = tangent[std::size_t(y) * object.width + x];
      const double wider = 1 + 0.4 * circle(1 - (y + 0.5) / object.height).x;
      n = Vec3f(normalized(Vec3d{n.x / wider, n.y, n.z}));
    }
  EXPECT_GT(lit_db(from_tangent_space(ring, object, tangent)), 45);
}

}  // namespace
}  // namespace burnish
