#include <gtest/gtest.h>

#include "burnish/render/mesh_surface.h"
#include "burnish/render/metrics.h"
#include "expect_error.h"
#include "render_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::quad_scene;
using testing::render;

// The quad that quad_scene() shows, as two triangles, with its texture coordinates; written as OBJ.
const std::string kQuadObj =
    "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

class RenderMesh : public ::testing::Test {
 protected:
  // The scene with its quad as a mesh, and `text` for the mesh.
  Scene mesh_scene(int size_px, const std::string& text = kQuadObj) {
    testing::write_bytes(dir_ / "quad.obj", text);
    Scene s = quad_scene(size_px);
    s.objects[0].surface.type = SurfaceType::kMesh;
    s.objects[0].mesh = dir_ / "quad.obj";
    return s;
  }
  testing::ScratchDir dir_;
};

TEST_F(RenderMesh, AQuadOfTrianglesIsTheQuad) {
  Scene as_mesh = mesh_scene(63), as_quad = quad_scene(63);
  Image map(16, 16, 3);
  const std::vector<Vec3f> normals = testing::spread_normals(256, true);
  for (int i = 0; i < 256; i++)
    map.data[3 * i] = normals[i].x, map.data[3 * i + 1] = normals[i].y, map.data[3 * i + 2] = normals[i].z;
  write_image(dir_ / "n.exr", FileType::kExr, SampleType::kFloat, map);
  std::vector<Frame> frames;
  for (Scene* s : {&as_mesh, &as_quad}) {
    s->objects[0].normal_map = dir_ / "n.exr";
    s->objects[0].transform.rotation = rotation_xyz({0.4, 0.3, 0.2});
    s->lights[0].direction = normalized(Vec3d{1, 2, 2});
    frames.push_back(render_frame(*s, load_assets(*s), {RenderPath::kAnalytic, 1, 0, {Aov::kUv, Aov::kNormal}}));
  }
  EXPECT_EQ(frames[0].covered.data, frames[1].covered.data);
  // The middle row and column of the 63 lie on a border between texels, which rounding may move.
  ByteImage inside_texels = frames[0].covered;
  for (int i = 0; i < 63; i++) *inside_texels.at(31, i) = *inside_texels.at(i, 31) = 0;
  const ErrorMetrics m = compare(frames[0].colour, frames[1].colour, inside_texels);
  EXPECT_GT(m.pixels, 1000u);
  EXPECT_LE(m.max_abs, 1e-6);
  for (std::size_t i = 0; i < frames[0].aovs[0].data.size(); i++)
    ASSERT_NEAR(frames[0].aovs[0].data[i], frames[1].aovs[0].data[i], 1e-6);
}

TEST_F(RenderMesh, MipLevelsAreThoseOfTheQuad) {
  Scene as_mesh = mesh_scene(16), as_quad = quad_scene(16);
  ObjectAssets indexed = testing::indexed_assets(as_quad, 64, 8, true);
  for (int side = 32; side >= 1; side /= 2) indexed.indexed->levels.emplace_back(side, side);
  indexed.space = NormalSpace::kObject;
  const auto levels = [&](Scene& s) {
    s.objects[0].mip = MipMode::kNearest;
    s.objects[0].normal_map.clear();
    ObjectAssets a = indexed;
    a.only_material = &s.materials[0], a.interval_materials = {&s.materials[0]};
    if (!s.objects[0].mesh.empty()) a.mesh = load_assets(s)[0].mesh;
    return render(s, a, RenderPath::kPalette, {Aov::kLevel}).aovs[0].data;
  };
  EXPECT_EQ(levels(as_mesh), levels(as_quad));
}

TEST_F(RenderMesh, WithoutMapsItsOwnNormalsAreShadedSmoothOrFlat) {
  // A tent over the x axis: smooth shading rounds its ridge.
  const std::string tent =
      "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0 0.25\nv -0.5 0 0.25\nv 0.5 0.5 0\nv -0.5 0.5 0\n"
      "f 1 2 3 4\nf 4 3 5 6\n";
  Scene s = mesh_scene(32, tent);
  s.objects[0].normal_map.clear();
  const auto normal_y = [&](MeshShading shading) {
    s.objects[0].shading = shading;
    const Frame f = render_frame(s, load_assets(s), {RenderPath::kAnalytic, 1, 0, {Aov::kNormal}});
    return std::pair(f.aovs[0].at(16, 15)[1], f.aovs[0].at(16, 16)[1]);  // above and below the ridge
  };
  const auto [flat_above, flat_below] = normal_y(MeshShading::kFlat);
  const double slope = 0.25 / std::hypot(0.5, 0.25);
  EXPECT_NEAR(flat_above, slope, 1e-6);
  EXPECT_NEAR(flat_below, -slope, 1e-6);
  const auto [smooth_above, smooth_below] = normal_y(MeshShading::kSmooth);
  EXPECT_LT(std::abs(smooth_above), 0.1);
  EXPECT_LT(std::abs(smooth_below), 0.1);
}

TEST_F(RenderMesh, OnlyTheOutsideIsSeen) {
  Scene s = mesh_scene(8);
  s.objects[0].normal_map.clear();
  const auto covered = [&] {
    const Frame f = render_frame(s, load_assets(s), {RenderPath::kAnalytic, 1, 0, {}});
    return std::ranges::count(f.covered.data, 1);
  };
  EXPECT_EQ(covered(), 64);
  s.objects[0].transform.rotation = rotation_xyz({0, kPi, 0});
  EXPECT_EQ(covered(), 0);
}

TEST_F(RenderMesh, MapsNeedTextureCoordinates) {
  Scene s = mesh_scene(8, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_ERROR(load_assets(s), ErrorKind::kMalformed,
               "expected texture coordinates, since the object has maps, got none");
}

}  // namespace
}  // namespace burnish
