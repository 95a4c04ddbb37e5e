#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../mesh_patterns.h"
#include "burnish/mesh/mesh_rays.h"
#include "burnish/mesh/simplify/decimate.h"
#include "mesh_topology.h"

namespace burnish {
namespace {

// The largest distance, in the texture, between the texture coordinates of a triangle's middle and those of the nearest
// point of the original.
double texture_error(const Mesh& low, const Mesh& high) {
  const MeshRays rays(high);
  double worst = 0;
  for (std::uint32_t t = 0; t < low.triangles.size(); t++) {
    const MeshPoint middle{t, {1 / 3.0, 1 / 3.0, 1 / 3.0}};
    const auto near = rays.nearest(position_at(low, middle), 10);
    const Vec2d d = uv_at(low, middle) - uv_at(high, near->point);
    worst = std::max(worst, std::sqrt(d.x * d.x + d.y * d.y));
  }
  return worst;
}

TEST(Decimate, TexturesKeepTheirPlace) {
  for (const char* name : {"sphere", "torus", "mirrored-torus", "split-torus", "sheet"}) {
    const Mesh high = named_mesh(name, 48);
    const Mesh low = decimate(high, high.triangles.size() / 10);
    EXPECT_LE(low.triangles.size(), high.triangles.size() / 10) << name;
    EXPECT_EQ(low.triangle_uvs.size(), low.triangles.size());
    // One texel of 48, about: what one of the original's triangles spans.
    EXPECT_LT(texture_error(low, high), 0.02) << name;
    EXPECT_EQ(euler_characteristic(low), euler_characteristic(high)) << name;
  }
}

TEST(Decimate, SeamsDoNotTearAndNothingTurnsOverInTheTexture) {
  for (const char* name : {"torus", "split-torus", "mirrored-torus"}) {
    const Mesh high = named_mesh(name, 32), low = decimate(high, 300);
    double area = 0, before = 0;
    for (std::size_t t = 0; t < low.triangles.size(); t++)
      area += std::abs(cross(low.uv(t, 1) - low.uv(t, 0), low.uv(t, 2) - low.uv(t, 0)));
    for (std::size_t t = 0; t < high.triangles.size(); t++)
      before += std::abs(cross(high.uv(t, 1) - high.uv(t, 0), high.uv(t, 2) - high.uv(t, 0)));
    // Charts with straight borders still cover all of the texture, each place once; at a mirror there is no seam, and
    // what meets there may give way a little.
    EXPECT_NEAR(area, before, (std::string(name) == "mirrored-torus" ? 0.01 : 1e-6) * before) << name;
    for (std::size_t t = 0; t < low.triangles.size(); t++)
      if (std::string(name) != "mirrored-torus") {
        EXPECT_GT(cross(low.uv(t, 1) - low.uv(t, 0), low.uv(t, 2) - low.uv(t, 0)), 0) << name;
      }
    EXPECT_TRUE(is_closed(low)) << name;
  }
}

// Where a map may be baked: in the square that the originals' lie in. A border and a mirror line are where free
// vertices would leave it.
TEST(Decimate, TextureCoordinatesStayInTheSquare) {
  for (const char* name : {"square-sheet", "mirrored-sheet", "torus", "mirrored-torus", "split-torus"})
    for (const std::size_t faces : {300, 60}) {
      double least = 0, most = 1;
      for (const Vec2d& uv : decimate(named_mesh(name, 24), faces).uvs)
        least = std::min({least, uv.x, uv.y}), most = std::max({most, uv.x, uv.y});
      EXPECT_EQ(least, 0) << name << ' ' << faces;
      EXPECT_EQ(most - 1, 0) << name << ' ' << faces;
    }
  // The sheet's map is still whole: its border stays where it was.
  const Mesh low = decimate(named_mesh("square-sheet", 24), 60);
  double area2 = 0;
  for (const Corners& t : low.triangle_uvs)
    area2 += cross(low.uvs[t[1]] - low.uvs[t[0]], low.uvs[t[2]] - low.uvs[t[0]]);
  EXPECT_NEAR(area2 / 2, 1, 1e-9);
}

}  // namespace
}  // namespace burnish
