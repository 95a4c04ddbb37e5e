#include <gtest/gtest.h>

#include <set>

#include "burnish/palette/octahedral.h"
#include "burnish/palette/palette_order.h"
#include "palette_fixture.h"

namespace burnish {
namespace {

using testing::angle_deg;
using testing::Random;

TEST(PaletteOctahedral, ToAndFroIsExactToRounding) {
  Random random(1);
  for (int i = 0; i < 10000; i++) {
    const Vec3d n = normalized(Vec3d(random.direction()));
    const Octahedral o = to_octahedral(n);
    ASSERT_LE(std::abs(o.u), 1 + 1e-15);
    ASSERT_LE(std::abs(o.v), 1 + 1e-15);
    ASSERT_LT(angle_rad(from_octahedral(o), n), 1e-14) << n.x << " " << n.y << " " << n.z;
  }
}

TEST(PaletteOctahedral, AxesComeBackAsTheyWentIn) {
  for (const Vec3d axis :
       {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}})
    for (const int bits : {2, 8, 12, 16, 24, 31}) {
      const Vec3d back = unpack_octahedral(pack_octahedral(axis, bits), bits);
      EXPECT_EQ(back.x, axis.x) << bits;
      EXPECT_EQ(back.y, axis.y) << bits;
      EXPECT_EQ(back.z, axis.z) << bits;
    }
}

TEST(PaletteOctahedral, PackingIsOffByHalfAStepOfTheSquare) {
  Random random(2);
  for (const int bits : {8, 12, 16, 24}) {
    // A step of the square is 1/scale; the map stretches by √3 at most at the face centres (distance 1/√3
    // from the origin), and half a step in both directions is √½ of one.
    const double scale = double((1 << (bits - 1)) - 1), bound = std::sqrt(0.5) / scale * 3;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
      const Vec3d n = normalized(Vec3d(random.direction()));
      const std::uint64_t key = pack_octahedral(n, bits);
      ASSERT_LT(key, std::uint64_t(1) << (2 * bits));
      const double off = angle_rad(unpack_octahedral(key, bits), n);
      ASSERT_LT(off, bound) << bits << " bits: " << n.x << " " << n.y << " " << n.z;
      worst = std::max(worst, off);
    }
    EXPECT_GT(worst, bound / 6) << "the bound says nothing at " << bits << " bits";
  }
}

TEST(PaletteOctahedral, PackingWhatWasUnpackedGivesTheSameVector) {
  Random random(3);
  for (int i = 0; i < 20000; i++) {
    const Vec3d once = unpack_octahedral(pack_octahedral(Vec3d(random.direction()), 24), 24);
    const Vec3d twice = unpack_octahedral(pack_octahedral(once, 24), 24);
    ASSERT_EQ(once.x, twice.x) << i;
    ASSERT_EQ(once.y, twice.y) << i;
    ASSERT_EQ(once.z, twice.z) << i;
  }
}

// Along the curve the next of many normals is near; in a random order it would be 90° away on average.
TEST(PaletteOrder, NeighboursOnTheCurveAreNeighboursOnTheSphere) {
  for (const int n : {256, 4096, 65536}) {
    std::vector<Vec3f> normals = testing::fibonacci_sphere(n);
    std::ranges::sort(normals, {}, curve_position);
    double sum = 0;
    for (int i = 1; i < n; i++) sum += angle_deg(normals[i - 1], normals[i]);
    // Neighbours of n points spread evenly are about √(4π/n) apart.
    const double spacing = degrees(std::sqrt(4 * kPi / n));
    EXPECT_LT(sum / (n - 1), 1.6 * spacing) << n;
  }
}

TEST(PaletteOrder, PositionsCloseOnTheCurveAreCloseOnTheSphere) {
  Random random(5);
  const std::vector<Vec3f> normals = random.directions(3000);
  for (const Vec3f& a : normals) {
    const Vec3f b = Vec3f(normalized(Vec3d(a) + Vec3d(random.direction()) * 1e-3));
    const std::uint64_t pa = curve_position(a), pb = curve_position(b);
    const double apart = double(pa > pb ? pa - pb : pb - pa) / 4294967296.0;  // of the whole curve
    // A stretch of length t of a Hilbert curve lies within √(6t) of the unit square; twice that of [−1,1]²,
    // and 3 times that in angle.
    ASSERT_LE(angle_rad(Vec3d(a), Vec3d(b)), 3 * 2 * std::sqrt(6 * apart) + 2e-4);
  }
}

TEST(PaletteOrder, PositionsOfDistinctNormalsAreDistinct) {
  std::set<std::uint64_t> seen;
  // 16 bits a coordinate tell 65536 normals apart that are 0.8° from each other.
  const std::vector<Vec3f> normals = testing::fibonacci_sphere(65536);
  for (const Vec3f& n : normals) {
    const std::uint64_t position = curve_position(n);
    EXPECT_LT(position, std::uint64_t(1) << 32);
    seen.insert(position);
  }
  EXPECT_EQ(seen.size(), normals.size());
}

}  // namespace
}  // namespace burnish
