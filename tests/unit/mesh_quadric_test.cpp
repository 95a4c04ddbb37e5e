#include <gtest/gtest.h>

#include "burnish/mesh/simplify/quadric.h"

namespace burnish {
namespace {

TEST(Quadric, IsTheDistanceToPointsLinesAndPlanes) {
  const PointN<3> at{{1, 2, 3}}, x{{1, 0, 0}}, y{{0, 1, 0}}, p{{4, 6, 15}};
  EXPECT_NEAR(Quadric<3>::of_flat(at, {}, 1)(p), 9 + 16 + 144, 1e-12);
  EXPECT_NEAR(Quadric<3>::of_flat(at, {x}, 2)(p), 2 * (16 + 144), 1e-12);
  EXPECT_NEAR(Quadric<3>::of_flat(at, {x, y}, 0.5)(p), 72, 1e-12);
  EXPECT_NEAR(Quadric<3>::of_flat(at, {x, y}, 0.5)(at + x * 7), 0, 1e-12);
}

TEST(Quadric, IsLeastWhereThreePlanesMeet) {
  const auto plane = [](PointN<3> u, PointN<3> v, PointN<3> at) {
    u = normalized(u), v = v - u * dot(u, v);
    return Quadric<3>::of_flat(at, {u, normalized(v)}, 1);
  };
  const PointN<3> meet{{0.3, -0.7, 2}}, a{{1, 0.2, 0}}, b{{0, 1, 0.4}}, c{{0.3, 0, 1}};
  const Quadric<3> three = plane(a, b, meet) + plane(b, c, meet + b * 3) + plane(c, a, meet - c * 2);
  const PointN<3> found = three.minimum({});
  for (int i = 0; i < 3; i++) EXPECT_NEAR(found[i], meet[i], 1e-9);
  EXPECT_EQ(plane(a, b, meet).minimum(c), c);  // anywhere on it
}

}  // namespace
}  // namespace burnish
