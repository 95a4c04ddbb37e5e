#include "burnish/mesh/files/mesh_io.h"

#include <gtest/gtest.h>

#include "expect_error.h"
#include "mesh_samples.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::MeshSample;
using testing::ScratchDir;

class MeshIo : public ::testing::Test {
 protected:
  Mesh read(const std::string& leaf, const std::string& text, MeshReadStats* stats = nullptr) {
    testing::write_bytes(dir_ / leaf, text);
    return read_mesh(dir_ / leaf, stats);
  }
  ScratchDir dir_;
};

// The same triangles in the same order with the same values at their corners, however they share indices.
void expect_same(const Mesh& a, const Mesh& b, const std::string& what) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size()) << what;
  ASSERT_EQ(a.has_uvs(), b.has_uvs()) << what;
  ASSERT_EQ(a.has_normals(), b.has_normals()) << what;
  for (std::size_t t = 0; t < a.triangles.size(); t++)
    for (int c = 0; c < 3; c++) {
      EXPECT_EQ(a.position(t, c), b.position(t, c)) << what;
      if (a.has_uvs()) {
        EXPECT_EQ(a.uv(t, c), b.uv(t, c)) << what;
      }
      if (a.has_normals()) {
        EXPECT_EQ(a.normal(t, c), b.normal(t, c)) << what;
      }
    }
}

TEST_F(MeshIo, EveryFormatAndDialectHoldsTheSameMesh) {
  for (const MeshSample& sample : testing::mesh_samples()) {
    MeshReadStats stats;
    const Mesh m = read(sample.leaf, sample.bytes, &stats);
    ASSERT_EQ(m.triangles.size(), 3u) << sample.leaf;
    EXPECT_EQ(m.positions.size(), 5u) << sample.leaf;
    EXPECT_EQ(stats.dropped_faces, 0u) << sample.leaf;
    ASSERT_EQ(m.has_uvs(), sample.uvs) << sample.leaf;
    ASSERT_EQ(m.has_normals(), sample.normals) << sample.leaf;
    for (int t = 0; t < 3; t++)
      for (int c = 0; c < 3; c++) {
        const std::uint32_t v = testing::kSampleTriangles[t][c];
        const double *p = testing::kSamplePositions[v], *uv = testing::kSampleUvs[v];
        EXPECT_EQ(m.position(t, c), (Vec3d{p[0], p[1], p[2]})) << sample.leaf;
        if (m.has_uvs()) {
          EXPECT_EQ(m.uv(t, c), (Vec2d{uv[0], uv[1]})) << sample.leaf;
        }
        if (m.has_normals()) {
          EXPECT_EQ(m.normal(t, c), (Vec3d{0, 0, 1})) << sample.leaf;
        }
      }
  }
}

TEST_F(MeshIo, LinesEndInAnyWay) {
  for (const MeshSample& sample : testing::mesh_samples()) {
    if (sample.bytes.find('\0') != sample.bytes.npos) continue;
    std::string unix_lines, dos_lines, mac_lines;
    for (char c : sample.bytes)
      if (c == '\n') unix_lines += "\n", dos_lines += "\r\n", mac_lines += "\r";
      else if (c != '\r') unix_lines += c, dos_lines += c, mac_lines += c;
    const Mesh m = read(sample.leaf, unix_lines);
    expect_same(read(sample.leaf, dos_lines), m, "dos " + sample.leaf);
    expect_same(read(sample.leaf, mac_lines), m, "mac " + sample.leaf);
    expect_same(read(sample.leaf, "\xEF\xBB\xBF" + unix_lines), m, "marked " + sample.leaf);
  }
}

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

TEST_F(MeshIo, FacesOnACrowdedEdgeAreKept) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\nf 1 3 2\n";
  const Mesh m = read("a.obj", text);
  EXPECT_EQ(m.triangles, (std::vector<Corners>{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 2, 1}}));
  for (const char* leaf : {"b.obj", "b.ply", "b.off", "b.stl"}) {
    write_mesh(dir_ / leaf, mesh_file_type_of(leaf), m);
    expect_same(read_mesh(dir_ / leaf), m, leaf);
  }
}

TEST_F(MeshIo, FacesWithoutAreaAreDroppedAndCounted) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 2 0 0\n";
  MeshReadStats stats;
  Mesh m = read("a.obj", vertices + "f 1 2 3\nf 1 1 2\nf 1 4 2\nf 1 2 5\nf 1 2 1 2\n", &stats);
  EXPECT_EQ(m.triangles, (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_EQ(stats.dropped_faces, 4u);
  // A quad with a corner twice is a triangle; one with three on a line keeps its area.
  m = read("a.obj", vertices + "f 1 2 2 3\nf 1 2 3 4\nf 1 2 5 3\n", &stats);
  EXPECT_EQ(stats.dropped_faces, 0u);
  EXPECT_EQ(m.triangles.size(), 4u);
  double area = 0;
  for (std::size_t t = 2; t < 4; t++) area += m.perpendicular(t).z / 2;
  EXPECT_EQ(area, 1);
  m = read("a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 2\n", &stats);
  EXPECT_EQ(m.triangles.size(), 1u);
  EXPECT_EQ(stats.dropped_faces, 2u);
  EXPECT_ERROR(read("a.obj", vertices + "f 1 2 5\n"), ErrorKind::kMalformed, "expected faces with area, got 1 without");
}

TEST_F(MeshIo, NormalsOfNoLengthBecomeTheTrianglesOwn) {
  const Mesh m =
      read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 0\nvn 0 3 0\nf 1//1 2//1 3//2\nf 1//1 3//2 4//1\n");
  EXPECT_EQ(m.normal(0, 0), (Vec3d{0, 0, 1}));
  EXPECT_EQ(m.normal(0, 1), (Vec3d{0, 0, 1}));
  EXPECT_EQ(m.normal(0, 2), (Vec3d{0, 1, 0}));
  EXPECT_EQ(m.normal(1, 0), (Vec3d{1, 0, 0}));
}

TEST_F(MeshIo, TheNameSaysTheType) {
  EXPECT_ERROR(read_mesh(dir_ / "none.obj"), ErrorKind::kIo, "none.obj");
  EXPECT_ERROR(read_mesh(dir_ / "mesh.fbx"), ErrorKind::kUnsupported, ".obj, .ply, .off, .stl");
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read("A.OFF", off).triangles.size(), 1u);
  EXPECT_ERROR(read("a.ply", off), ErrorKind::kMalformed, "expected 'ply', got 'OFF'");
}

TEST_F(MeshIo, NumbersTooSmallForADoubleAreZero) {
  EXPECT_EQ(read("tiny.obj", "v 0 0 1e-999\nv 1 0 0\nv 1 1 0\nf 3 1 2\n").position(0, 1), (Vec3d{0, 0, 0}));
}

TEST_F(MeshIo, WhatIsWrittenReadsBackTheSame) {
  const std::string text =
      "v 0 0 0\nv 1.25 0 0\nv 1 1 0\nv 0 1 0.123456789\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 1 0 0\n"
      "f 1/1/1 2/2/1 3/3/1\nf 1/1/2 3/3/2 4/4/2\n";
  const Mesh m = read("a.obj", text);
  Mesh bare = m;
  bare.uvs.clear(), bare.triangle_uvs.clear(), bare.normals.clear(), bare.triangle_normals.clear();
  for (const char* leaf : {"b.obj", "b.ply"}) {
    write_mesh(dir_ / leaf, mesh_file_type_of(leaf), m);
    expect_same(read_mesh(dir_ / leaf), m, leaf);
  }
  for (const char* leaf : {"c.obj", "c.ply", "c.off", "c.stl"}) {
    write_mesh(dir_ / leaf, mesh_file_type_of(leaf), bare);
    expect_same(read_mesh(dir_ / leaf), bare, leaf);
  }
  EXPECT_EQ(read_mesh(dir_ / "b.obj").triangles, m.triangles);
  EXPECT_EQ(read_mesh(dir_ / "b.ply").positions.size(), 6u);  // two on the edge with two normals
  EXPECT_ERROR(write_mesh(dir_ / "b.off", MeshFileType::kOff, m), ErrorKind::kUnsupported, "as OBJ or PLY only");
  EXPECT_ERROR(write_mesh(dir_ / "none/b.off", MeshFileType::kOff, bare), ErrorKind::kIo, "cannot be written");
}

}  // namespace
}  // namespace burnish
