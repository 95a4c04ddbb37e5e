#include "burnish/mesh/mesh_io.h"

#include <gtest/gtest.h>

#include <fstream>

#include "burnish/mesh/polygon.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

class MeshIo : public ::testing::Test {
 protected:
  Mesh read(const std::string& leaf, const std::string& text, MeshReadStats* stats = nullptr) {
    const std::string path = dir_ / leaf;
    std::ofstream(path, std::ios::binary) << text;
    return read_mesh(path, stats);
  }
  ScratchDir dir_;
};

TEST_F(MeshIo, ObjKeepsTextureCoordinatesAndNormalsOfEachCorner) {
  const Mesh m =
      read("a.obj",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\nvn 0 0 2\nvn 1 0 0\n"
           "f 1/1/1 2/2/1 3/3/1\nf 1/5/2 3/3/2 4/4/2\n");
  ASSERT_EQ(m.triangles.size(), 2u);
  EXPECT_EQ(m.position(1, 2), (Vec3d{0, 1, 0}));
  EXPECT_EQ(m.uv(0, 0), (Vec2d{0, 0}));
  EXPECT_EQ(m.uv(1, 0), (Vec2d{0.5, 0.5}));
  EXPECT_EQ(m.triangle_uvs[0][2], m.triangle_uvs[1][1]);  // shared: no seam there
  EXPECT_EQ(m.normal(0, 0), (Vec3d{0, 0, 1}));
  EXPECT_EQ(m.normal(1, 0), (Vec3d{1, 0, 0}));
}

TEST_F(MeshIo, FacesOnACrowdedEdgeAreKeptAndThoseWithoutAreaCounted) {
  MeshReadStats stats;
  const Mesh m =
      read("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\nf 1 1 2\n", &stats);
  ASSERT_EQ(m.triangles.size(), 3u);
  EXPECT_EQ(m.position(2, 2), (Vec3d{0, 0, 1}));
  EXPECT_EQ(stats.dropped_faces, 1u);
}

TEST_F(MeshIo, WhatObjFilesGetWrongIsSaidWithItsLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const auto refused = [&](const std::string& text, const std::string& part) {
    EXPECT_ERROR(read("bad.obj", text), ErrorKind::kMalformed, part);
  };
  refused("v 0 nan 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "line 1: expected 3 finite numbers after 'v', got 'nan'");
  refused(vertices + "f 1 2 9\n", "line 4: expected vertex 1 to 3, got 9");
  refused(vertices + "vt 0 0\nf 1/2 2/1 3/1\n", "line 5: expected texture coordinate 1 to 1, got 2");
  refused(vertices + "vt 0 0\nf 1/1 2 3/1\n", "every corner to name its texture coordinate or none");
  refused(vertices + "f 1 2\n", "at least 3 corners");
  refused(vertices + "f 1 2 x\n", "'x'");
  refused(vertices + "f 1 2 -4\n", "'-4'");
  refused(vertices, "expected a mesh with faces, got none");
  refused("", "expected a mesh with faces, got none");
  EXPECT_ERROR(read_mesh(dir_ / "none.obj"), ErrorKind::kIo, "none.obj");
  EXPECT_ERROR(read_mesh(dir_ / "mesh.fbx"), ErrorKind::kUnsupported, ".obj, .ply, .off, .stl");
}

TEST_F(MeshIo, OtherFormatsAreRead) {
  const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 0.25\n3 0 1 2\n";
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
  EXPECT_EQ(read("a.off", off).triangles.size(), 2u);
  const Mesh p = read("a.ply", ply);
  ASSERT_TRUE(p.has_uvs() && p.has_normals());
  EXPECT_EQ(p.uv(0, 2), (Vec2d{1, 0.25}));
  EXPECT_EQ(p.normal(0, 1), (Vec3d{0, 0, 1}));
  const Mesh s = read("a.stl", stl);
  EXPECT_EQ(s.triangles.size(), 2u);
  EXPECT_EQ(s.positions.size(), 4u);  // welded
}

TEST_F(MeshIo, WhatIsWrittenReadsBackTheSame) {
  const std::string text =
      "v 0 0 0\nv 1.25 0 0\nv 1 1 0\nv 0 1 0.123456789\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 1 0 0\n"
      "f 1/1/1 2/2/1 3/3/1\nf 1/1/2 3/3/2 4/4/2\n";
  const Mesh m = read("a.obj", text);
  write_mesh(dir_ / "b.obj", MeshFileType::kObj, m);
  const Mesh back = read_mesh(dir_ / "b.obj");
  ASSERT_EQ(back.triangles, m.triangles);
  for (std::size_t t = 0; t < 2; t++)
    for (int c = 0; c < 3; c++) {
      EXPECT_EQ(back.position(t, c), m.position(t, c));
      EXPECT_EQ(back.uv(t, c), m.uv(t, c));
      EXPECT_EQ(back.normal(t, c), m.normal(t, c));
    }
  EXPECT_ERROR(write_mesh(dir_ / "b.ply", MeshFileType::kPly, m), ErrorKind::kUnsupported, "OBJ only");
  Mesh bare = m;
  bare.uvs.clear(), bare.triangle_uvs.clear(), bare.normals.clear(), bare.triangle_normals.clear();
  for (const char* leaf : {"c.ply", "c.off", "c.stl"}) {
    write_mesh(dir_ / leaf, mesh_file_type_of(leaf), bare);
    EXPECT_EQ(read_mesh(dir_ / leaf).triangles.size(), 2u) << leaf;
  }
}

TEST(Polygon, ConvexOnesBecomeFansAndOthersKeepTheirArea) {
  const std::vector<Vec3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(square), (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
  const std::vector<Vec3d> arrow{{0, 0, 0}, {2, -1, 0}, {0, 2, 0}, {-2, -1, 0}};  // reflex at the first corner
  const std::vector<Vec3d> comb{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {3, 0.5, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}};
  for (const auto& outline : {arrow, comb}) {
    double whole = 0, sum = 0;
    for (std::size_t i = 0; i < outline.size(); i++) whole += cross(outline[i], outline[(i + 1) % outline.size()]).z;
    for (const Corners& t : triangulate(outline)) {
      const double area = cross(outline[t[1]] - outline[t[0]], outline[t[2]] - outline[t[0]]).z;
      EXPECT_GT(area, 0);
      sum += area;
    }
    EXPECT_NEAR(sum, whole, 1e-12);
  }
}

TEST(Mesh, SmoothNormalsOfACubeWeldedOrNotPointOutOfItsCorners) {
  Mesh cube;
  for (int i = 0; i < 8; i++) cube.positions.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    cube.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
    cube.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[2]), std::uint32_t(f[3])});
  }
  Mesh split = cube;
  split.positions.clear();
  for (Corners& t : split.triangles)
    for (std::uint32_t& i : t) {
      split.positions.push_back(cube.positions[i]);
      i = std::uint32_t(split.positions.size() - 1);
    }
  for (Mesh* m : {&cube, &split}) {
    add_smooth_normals(*m);
    for (std::size_t t = 0; t < m->triangles.size(); t++)
      for (int c = 0; c < 3; c++) EXPECT_LT(angle_rad(m->normal(t, c), m->position(t, c)), 1e-9);
  }
}

}  // namespace
}  // namespace burnish
