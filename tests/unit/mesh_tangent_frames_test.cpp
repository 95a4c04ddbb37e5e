#include <gtest/gtest.h>

#include "../mesh_patterns.h"
#include "burnish/mesh/tangent_frames.h"

namespace burnish {
namespace {

double degrees_between(Vec3d a, Vec3d b) { return degrees(angle_rad(a, b)); }

// A fan of triangles around the first position; its ring holds the others, in order.
Mesh fan(std::vector<Vec3d> positions, std::vector<Vec2d> uvs, bool closed, Vec3d normal = {0, 0, 1}) {
  Mesh mesh;
  const std::uint32_t ring = std::uint32_t(positions.size()) - 1;
  for (std::uint32_t i = 0; i + (closed ? 0 : 1) < ring; i++) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % ring});
  mesh.positions = std::move(positions), mesh.uvs = std::move(uvs), mesh.normals = {normal};
  mesh.triangle_uvs = mesh.triangles;
  mesh.triangle_normals.assign(mesh.triangles.size(), {0, 0, 0});
  return mesh;
}

std::vector<Mesh> all_kinds() {
  std::vector<Mesh> out;
  for (const char* name : {"sphere", "mirrored-sphere", "torus", "mirrored-torus", "split-torus",
                           "split-mirrored-sphere", "sheet", "mirrored-sheet"}) {
    out.push_back(named_mesh(name, 12));
    out.back().name = name;
    add_smooth_normals(out.back());
  }
  return out;
}

TEST(TangentFrames, AreUnitPerpendicularToTheNormalAndSignedByTheTexturesHandedness) {
  for (const Mesh& mesh : all_kinds()) {
    const TangentFrames frames = tangent_frames(mesh);
    ASSERT_EQ(frames.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < frames.size(); t++)
      for (int c = 0; c < 3; c++) {
        const auto& [tangent, sign] = frames[t][c];
        EXPECT_NEAR(length(tangent), 1, 1e-12) << mesh.name << ' ' << t;
        EXPECT_NEAR(dot(tangent, mesh.normal(t, c)), 0, 1e-12) << mesh.name << ' ' << t;
        const double area = cross(mesh.uv(t, 1) - mesh.uv(t, 0), mesh.uv(t, 2) - mesh.uv(t, 0));
        EXPECT_EQ(sign, area < 0 ? -1 : 1) << mesh.name << ' ' << t;
      }
  }
}

TEST(TangentFrames, OnAPlaneAreTheDirectionsOfTheTexture) {
  // u = (x cos a + y sin a)/2, v across, at any angle; mirrored, v runs the other way.
  for (const double hand : {1.0, -1.0})
    for (int step = 0; step < 12; step++) {
      const double a = 2 * kPi * step / 12 + 0.1;
      Mesh mesh = grid_mesh(
          4, 3,
          [](double u, double v) {
            return Vec3d{u, v, 0};
          },
          [&](double x, double y) {
            return Vec2d{(x * std::cos(a) + y * std::sin(a)) / 2, hand * 3 * (y * std::cos(a) - x * std::sin(a))};
          });
      add_smooth_normals(mesh);
      const TangentFrames frames = tangent_frames(mesh);
      for (std::size_t t = 0; t < frames.size(); t++)
        for (int c = 0; c < 3; c++) {
          EXPECT_LT(degrees_between(frames[t][c].tangent, {std::cos(a), std::sin(a), 0}), 1e-6);
          EXPECT_EQ(frames[t][c].sign, hand);
          const FrameAt at =
              frame_at(mesh, frames, {std::uint32_t(t), {c == 0 ? 1. : 0., c == 1 ? 1. : 0., c == 2 ? 1. : 0.}});
          EXPECT_LT(degrees_between(at.b, Vec3d{-std::sin(a), std::cos(a), 0} * hand), 1e-6);
        }
    }
}

TEST(TangentFrames, OnASphereRunEastAndMirroredWest) {
  for (const bool mirrored : {false, true}) {
    Mesh mesh = named_mesh(mirrored ? "mirrored-sphere" : "sphere", 64);
    add_smooth_normals(mesh);
    const TangentFrames frames = tangent_frames(mesh);
    for (std::size_t t = 0; t < frames.size(); t++)
      for (int c = 0; c < 3; c++) {
        const Vec3d p = mesh.position(t, c);
        if (std::abs(p.y) > 0.98) continue;
        const Vec3d east = normalized(cross(Vec3d{0, 1, 0}, p));
        // Half a column at the seam, where the triangles of one side have no others to average with.
        EXPECT_LT(degrees_between(frames[t][c].tangent, east * frames[t][c].sign), 180.0 / 128 + 0.1);
      }
  }
}

TEST(TangentFrames, AverageByAngleWhereTextureCoordinatesAreShared) {
  // Two triangles of 30° and 90° at the middle, in one plane, with tangents of their own there.
  const double s = std::sqrt(0.75);
  Mesh mesh = fan({{0, 0, 0}, {1, 0, 0}, {s, 0.5, 0}, {-0.5, s, 0}}, {{0, 0}, {1, 0}, {1, 0.5}, {0.2, 1}}, false);
  const auto along_u = [&](std::size_t t) {  // by solving p = u · p_u + v · p_v
    const Vec2d a = mesh.uv(t, 1), b = mesh.uv(t, 2);
    return normalized((mesh.position(t, 1) * b.y - mesh.position(t, 2) * a.y) / cross(a, b));
  };
  const Vec3d expected = normalized(along_u(0) * (kPi / 6) + along_u(1) * (kPi / 2));
  EXPECT_GT(degrees_between(along_u(0), along_u(1)), 3);
  TangentFrames frames = tangent_frames(mesh);
  EXPECT_LT(degrees_between(frames[0][0].tangent, expected), 1e-9);
  EXPECT_LT(degrees_between(frames[1][0].tangent, expected), 1e-9);
  // The corners that nothing shares have their own.
  EXPECT_LT(degrees_between(frames[0][1].tangent, along_u(0)), 1e-9);
  EXPECT_LT(degrees_between(frames[1][2].tangent, along_u(1)), 1e-9);

  // Repeated in the file, the same values are the same vertex; a texture that jumps or a normal that breaks is a seam.
  const auto own = [&](const Mesh& m) { return degrees_between(tangent_frames(m)[1][0].tangent, along_u(1)) < 1e-9; };
  Mesh repeated = mesh;
  for (std::uint32_t i = 0; i < 4; i++)
    repeated.uvs.push_back(mesh.uvs[i]), repeated.positions.push_back(mesh.positions[i]);
  for (int c = 0; c < 3; c++) repeated.triangle_uvs[1][c] += 4, repeated.triangles[1][c] += 4;
  EXPECT_LT(degrees_between(tangent_frames(repeated)[1][0].tangent, expected), 1e-9);
  Mesh seam = repeated;
  for (int i = 4; i < 8; i++) seam.uvs[i] = seam.uvs[i] + Vec2d{0.5, 0};
  EXPECT_TRUE(own(seam));
  Mesh crease = mesh;
  crease.normals.push_back(normalized(Vec3d{0, 0.1, 1}));
  crease.triangle_normals[1] = {1, 1, 1};
  EXPECT_LT(degrees_between(tangent_frames(crease)[0][0].tangent, along_u(0)), 1e-9);
}

TEST(TangentFrames, NeverMixHands) {
  // Vertex 0 lies on the mirror: right of it the texture is as it is, left of it mirrored.
  const Mesh mesh = fan({{0, 0, 0}, {0, -1, 0}, {1, 0.2, 0}, {0, 1, 0}, {-1, 0.4, 0}},
                        {{0, 0}, {0, -1}, {1, 0}, {0, 1}, {1, 0}}, true);
  const TangentFrames frames = tangent_frames(mesh);
  for (int t = 0; t < 4; t++) {
    EXPECT_EQ(frames[t][0].sign, t < 2 ? 1 : -1) << t;
    EXPECT_GT(frames[t][0].tangent.x * (t < 2 ? 1 : -1), 0.9) << t;
  }
  EXPECT_EQ(frames[0][0].tangent, frames[1][0].tangent);
  EXPECT_GT(std::abs(frames[0][0].tangent.y + frames[2][0].tangent.y), 0.05);  // no averages across the mirror
}

TEST(TangentFrames, OppositeOnesAroundAPoleDoNotCancel) {
  // A disk whose texture runs around its middle: seen from there, +u points in every direction.
  std::vector<Vec3d> positions{{0, 0, 0}};
  std::vector<Vec2d> uvs{{0.5, 1}};
  for (int i = 0; i <= 8; i++) {
    const Vec2d c = circle(i / 8.0);
    positions.push_back({c.x, c.y, 0});
    uvs.push_back({i / 8.0, 0});
  }
  Mesh mesh = fan(positions, uvs, false);
  const TangentFrames frames = tangent_frames(mesh);
  for (std::size_t t = 0; t < 8; t++)
    EXPECT_LT(degrees_between(frames[t][0].tangent, mesh.position(t, 2) - mesh.position(t, 1)), 1e-6) << t;
}

TEST(TangentFrames, TrianglesWithoutTextureAreaTakeThoseOfTheirNeighbours) {
  // Triangle 1 has its texture on a line, triangle 3 two corners at one place.
  const Mesh mesh = fan({{0, 0, 0}, {1, 0, 0}, {0.8, 0.7, 0}, {0, 1, 0}, {-0.9, 0.3, 0}, {-0.9, 0.3, 0}},
                        {{0.5, 0.5}, {1, 0.5}, {0.9, 0.8}, {0.1, 0.2}, {0.5, 0.1}, {0.55, 0.1}}, false);
  const TangentFrames frames = tangent_frames(mesh);
  EXPECT_EQ(frames[1][0].tangent, frames[0][0].tangent);
  EXPECT_EQ(frames[1][1].tangent, frames[0][2].tangent);
  EXPECT_EQ(frames[3][0].tangent, frames[2][0].tangent);
  EXPECT_EQ(frames[3][1].tangent, frames[2][2].tangent);
}

TEST(TangentFrames, WithoutAnyTextureAreaAreRightHandedAndPerpendicular) {
  for (const Vec3d n :
       {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, normalized(Vec3d{1, 2, 3}), normalized(Vec3d{-1, 1, 0})}) {
    const Mesh mesh = fan({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}, false, n);
    const TangentFrames frames = tangent_frames(mesh);
    for (const CornerTangent& corner : frames[0]) {
      EXPECT_EQ(corner.sign, 1);
      EXPECT_NEAR(length(corner.tangent), 1, 1e-12);
      EXPECT_NEAR(dot(corner.tangent, n), 0, 1e-12);
    }
  }
}

TEST(TangentFrames, DoNotDependOnTheOrderOfTriangles) {
  for (const Mesh& mesh : all_kinds()) {
    Mesh reversed = mesh;
    for (auto* list : {&reversed.triangles, &reversed.triangle_uvs, &reversed.triangle_normals})
      std::reverse(list->begin(), list->end());
    const TangentFrames a = tangent_frames(mesh), b = tangent_frames(reversed);
    for (std::size_t t = 0; t < a.size(); t++)
      for (int c = 0; c < 3; c++) {
        EXPECT_LT(degrees_between(a[t][c].tangent, b[a.size() - 1 - t][c].tangent), 1e-6) << mesh.name << ' ' << t;
        EXPECT_EQ(a[t][c].sign, b[a.size() - 1 - t][c].sign);
      }
  }
}

TEST(FrameAt, GoesThereAndBack) {
  for (const Mesh& mesh : all_kinds()) {
    const TangentFrames frames = tangent_frames(mesh);
    for (std::uint32_t t = 0; t < frames.size(); t += 7)
      for (const auto& weight : {std::array{1.0, 0.0, 0.0}, {0.2, 0.5, 0.3}, {1 / 3.0, 1 / 3.0, 1 / 3.0}}) {
        const FrameAt at = frame_at(mesh, frames, {t, weight});
        for (const Vec3d mapped : {Vec3d{0, 0, 1}, {0.6, 0, 0.8}, {-0.48, 0.6, 0.64}, {0.36, -0.8, 0.48}}) {
          EXPECT_LT(length(at.to_tangent(at.to_object(mapped)) - mapped), 1e-9) << mesh.name << ' ' << t;
          EXPECT_NEAR(length(at.to_object(mapped)), 1, 1e-12);
        }
        EXPECT_LT(length(at.to_object({0, 0, 1}) - normal_at(mesh, {t, weight})), 1e-9);
      }
  }
}

TEST(FrameAt, AtACornerIsTheCorners) {
  Mesh mesh = named_mesh("mirrored-torus", 8);
  add_smooth_normals(mesh);
  const TangentFrames frames = tangent_frames(mesh);
  for (std::uint32_t t = 0; t < frames.size(); t++) {
    const FrameAt at = frame_at(mesh, frames, {t, {0, 1, 0}});
    EXPECT_EQ(at.t, frames[t][1].tangent);
    EXPECT_LT(length(at.b - cross(mesh.normal(t, 1), at.t) * frames[t][1].sign), 1e-12);
  }
}

}  // namespace
}  // namespace burnish
