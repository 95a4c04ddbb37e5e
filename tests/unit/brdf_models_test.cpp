// The reflectance models by what must hold of them: limits, symmetries, closed forms, energy.
#include <gtest/gtest.h>

#include <random>

#include "burnish/brdf/banks.h"
#include "burnish/brdf/blinn_phong.h"
#include "burnish/brdf/light_factor.h"
#include "burnish/brdf/strand.h"
#include "burnish/brdf/ward.h"

namespace burnish {
namespace {

const LocalFrame kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

class Directions {
 public:
  Vec3d anywhere() {
    const double z = 2 * uniform() - 1, r = std::sqrt(1 - z * z), a = 2 * kPi * uniform();
    return {r * std::cos(a), r * std::sin(a), z};
  }
  Vec3d above() {
    const Vec3d d = anywhere();
    return {d.x, d.y, std::abs(d.z)};
  }
  double uniform() { return double(random_() >> 5) / double(1u << 27); }

 private:
  std::mt19937 random_{3};
};

Vec3d at(double polar_deg, double azimuth_deg) {
  const double t = radians(polar_deg), p = radians(azimuth_deg);
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

TEST(BrdfFrame, IsOrthonormalRightHandedAndNearestToTheDirection) {
  Directions d;
  for (int i = 0; i < 2000; i++) {
    const Vec3d n = d.anywhere() * (0.1 + d.uniform()), t = d.anywhere() * (0.1 + d.uniform());
    const LocalFrame f = orthonormal_frame(n, t).value();
    for (Vec3d v : {f.t, f.b, f.n}) EXPECT_NEAR(length(v), 1, 1e-12);
    EXPECT_NEAR(dot(f.t, f.n), 0, 1e-12);
    EXPECT_LT(length(cross(f.n, f.t) - f.b), 1e-12);
    EXPECT_NEAR(dot(f.t, t), length(t - f.n * dot(f.n, t)), 1e-9) << "T's projection on the plane across N";
  }
}

TEST(BrdfFrame, IsNoneWhereThereIsNoDirection) {
  EXPECT_FALSE(orthonormal_frame({0, 0, 1}, {0, 0, 3}));
  EXPECT_FALSE(orthonormal_frame({0, 0, 1}, {0, 0, 0}));
  EXPECT_FALSE(orthonormal_frame({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(orthonormal_frame({0, 0, 1}, {1e-8, 0, 1}));
  const LocalFrame near = orthonormal_frame({0, 0, 1}, {1e-5, 0, 1}).value();
  EXPECT_LT(length(near.t - Vec3d{1, 0, 0}), 1e-12);
}

TEST(BrdfBanks, InThePlaneOfTheFibreOnlyTheSumOfTheAnglesCounts) {
  // l and v at angles a and b from t, on either side of n: sin a sin b − cos a cos b = −cos(a + b).
  for (double a = 5; a < 180; a += 7)
    for (double b = 5; b < 180; b += 7) {
      const Vec3d l{std::cos(radians(a)), 0, std::sin(radians(a))}, v{std::cos(radians(b)), 0, std::sin(radians(b))};
      const double expected = 0.7 * std::sin(radians(a)) * std::max(0.0, -std::cos(radians(a + b)));
      EXPECT_NEAR(banks(kAxes, 0.7, l, v), expected, 1e-12);
    }
}

TEST(BrdfBanks, FibresReflectAlikeAllRound) {
  Directions d;
  for (int i = 0; i < 500; i++) {
    const Vec3d l = d.above(), v = d.above();
    const double turn = d.uniform() * 6;  // of the view round the fibre
    const Vec3d turned{v.x, v.y * std::cos(turn) - v.z * std::sin(turn), v.y * std::sin(turn) + v.z * std::cos(turn)};
    EXPECT_NEAR(banks(kAxes, 1, l, v), banks(kAxes, 1, l, turned), 1e-12);
    const double a = dot(v, kAxes.t), b = dot(l, kAxes.t);
    EXPECT_EQ(banks_fibre(a, b, banks_r), banks_fibre(b, a, banks_r)) << "reciprocal but for n·l";
  }
  EXPECT_EQ(banks(kAxes, 1, {0, 0, -1}, {0, 0, 1}), 0);
}

TEST(BrdfBanks, TheApproximationMeetsTheEndsAndIsNeverMoreThanTheRoot) {
  EXPECT_EQ(banks_r_approximate(0), banks_r(0));
  EXPECT_EQ(banks_r_approximate(1), banks_r(1));
  double most = 0;
  for (double s = 0; s <= 1; s += 1.0 / 1024) {
    EXPECT_LE(banks_r_approximate(s), banks_r(s));
    most = std::max(most, banks_r(s) - banks_r_approximate(s));
  }
  EXPECT_NEAR(most, 0.25, 1e-9) << "at s = 3/4";
}

TEST(BrdfBlinnPhong, WithoutAnisotropyIsBlinnsCosinePower) {
  Directions d;
  for (int i = 0; i < 500; i++) {
    const Vec3d h = d.above();
    const BlinnPhong m{0.8, 1, 1, 1 + 60 * d.uniform()};
    EXPECT_NEAR(blinn_phong(kAxes, m, h), 0.8 * std::pow(h.z, m.exponent), 1e-12);
    EXPECT_EQ(blinn_phong(kAxes, m, -h), 0) << "the sign of h·n, which Pythagoras loses";
    EXPECT_EQ(blinn_phong_equation_1(kAxes, m, -h), 0);
  }
}

TEST(BrdfBlinnPhong, Equation1IsFAtTwo) {
  Directions d;
  for (int i = 0; i < 500; i++) {
    const Vec3d h = d.above();
    const BlinnPhong m{0.6, 0.2 + 0.8 * d.uniform(), 0.2 + 0.8 * d.uniform(), 2};
    EXPECT_NEAR(blinn_phong(kAxes, m, h), blinn_phong_equation_1(kAxes, m, h), 1e-15);
  }
}

TEST(BrdfBlinnPhong, ASmallerAlphaIsSharperAlongItsOwnAxisOnly) {
  const BlinnPhong m{1, 0.3, 0.9, 1};
  EXPECT_LT(blinn_phong(kAxes, m, at(15, 0)), blinn_phong(kAxes, m, at(15, 90)));
  EXPECT_EQ(blinn_phong(kAxes, m, at(18, 0)), 0) << "sin 18° > 0.3";
  EXPECT_NEAR(blinn_phong(kAxes, m, at(18, 90)), std::sqrt(1 - std::pow(std::sin(radians(18)) / 0.9, 2)), 1e-12);
  for (double a = 0; a < 360; a += 15)
    EXPECT_NEAR(blinn_phong(kAxes, m, at(10, a)), blinn_phong(kAxes, m, at(10, a + 180)), 1e-12);
}

TEST(BrdfWard, IsReciprocalAndNothingBelowTheSurface) {
  Directions d;
  for (int i = 0; i < 500; i++) {
    const Vec3d l = d.above(), v = d.above();
    const Ward w{0.5, 0.1 + 0.5 * d.uniform(), 0.1 + 0.5 * d.uniform()};
    EXPECT_NEAR(ward_brdf(kAxes, w, l, v), ward_brdf(kAxes, w, v, l), 1e-12 * ward_brdf(kAxes, w, l, v) + 1e-300);
    EXPECT_EQ(ward_brdf(kAxes, w, -l, v), 0);
    EXPECT_EQ(ward_brdf(kAxes, w, l, -v), 0);
    EXPECT_NEAR(ward(kAxes, w, l, v), ward_brdf(kAxes, w, l, v) * l.z, 1e-12);
  }
}

TEST(BrdfWard, ClosedFormsAtTheMirrorAndInThePlaneOfIncidence) {
  const Ward w{0.7, 0.15, 0.4};
  EXPECT_NEAR(ward_brdf(kAxes, w, kAxes.n, kAxes.n), 0.7 / (4 * kPi * 0.15 * 0.4), 1e-12);
  // Mirror directions at 60°: h = n, so that only 1/√p = 2 remains.
  EXPECT_NEAR(ward_brdf(kAxes, w, at(60, 20), at(60, 200)), 2 * 0.7 / (4 * kPi * 0.15 * 0.4), 1e-12);
  // Light straight above, view at 2a along t: h at a, and −2 sin²a/(1 + cos a) = −2(1 − cos a).
  const double a = radians(12), expected = 0.7 / (4 * kPi * 0.15 * 0.4) / std::sqrt(std::cos(2 * a)) *
                                           std::exp(-2 * (1 - std::cos(a)) / (0.15 * 0.15));
  EXPECT_NEAR(ward_brdf(kAxes, w, kAxes.n, at(24, 0)), expected, 1e-12);
}

// ∫ f_r cos θ_l dω_l by the midpoint rule over the hemisphere.
double albedo(const Ward& w, Vec3d v) {
  constexpr int kPolar = 600, kAzimuth = 600;
  double sum = 0;
  for (int i = 0; i < kPolar; i++)
    for (int j = 0; j < kAzimuth; j++) {
      const double t = (i + 0.5) / kPolar * kPi / 2, p = (j + 0.5) / kAzimuth * 2 * kPi;
      const Vec3d l{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
      sum += ward(kAxes, w, l, v) * std::sin(t);
    }
  return sum * (kPi / 2 / kPolar) * (2 * kPi / kAzimuth);
}

TEST(BrdfWard, ReflectsNoMoreThanItGets) {
  for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.15, 0.4}, {0.5, 0.5}, {0.05, 0.3}})
    for (double polar : {0.0, 45.0, 75.0, 85.0, 88.0})
      for (double azimuth : {0.0, 30.0, 90.0})
        EXPECT_LE(albedo({1, x, y}, at(polar, azimuth)), 1)
            << x << " " << y << ", view " << polar << "°, " << azimuth << "°";
  for (double polar : {0.0, 30.0, 45.0, 60.0})  // as α goes to 0: dω_l = 4 (h·l) dω_h leaves cos θ_v
    EXPECT_NEAR(albedo({1, 0.05, 0.05}, at(polar, 10)), std::cos(radians(polar)), 0.005);
}

TEST(BrdfStrand, IsTheBestOfPhongOverAllNormalsOfTheStrand) {
  Directions d;
  const Vec3d t{1, 0, 0};
  for (int i = 0; i < 200; i++) {
    const Vec3d l = d.anywhere(), v = d.anywhere();
    double diffuse = 0, specular = 0;
    for (int k = 0; k < 20000; k++) {
      const double a = 2 * kPi * k / 20000;
      const Vec3d n{0, std::cos(a), std::sin(a)};
      diffuse = std::max(diffuse, dot(n, l));
      specular = std::max(specular, dot(v, n * (2 * dot(n, l)) - l));
    }
    EXPECT_NEAR(strand_diffuse(dot(l, t)), diffuse, 1e-6);
    EXPECT_NEAR(strand_specular(dot(l, t), dot(v, t), 1), specular, 1e-6);
    EXPECT_NEAR(strand_specular(dot(l, t), dot(v, t), 7), std::pow(specular, 7), 1e-5);
    EXPECT_EQ(strand_specular(dot(l, t), dot(v, t), 7), strand_specular(dot(v, t), dot(l, t), 7));
  }
}

TEST(BrdfStrand, IsWholeAcrossAndNothingAlong) {
  EXPECT_EQ(strand_diffuse(0), 1);
  EXPECT_EQ(strand_diffuse(1), 0);
  EXPECT_EQ(strand_diffuse(-1), 0);
  EXPECT_EQ(strand_specular(0.6, -0.6, 50), 1) << "mirrored about the plane across the strand";
  EXPECT_EQ(strand_specular(0.6, 0.9, 50), 0);
}

TEST(BrdfLightFactor, GoesSmoothlyFromAmbientToLight) {
  EXPECT_EQ(light_factor(-1, 0.9, 0.1, 0.25), 0.1);
  EXPECT_EQ(light_factor(0, 0.9, 0.1, 0.25), 0.1);
  EXPECT_NEAR(light_factor(0.125, 0.9, 0.1, 0.25), 0.5, 1e-12);
  EXPECT_EQ(light_factor(0.25, 0.9, 0.1, 0.25), 0.9);
  EXPECT_EQ(light_factor(1, 0.9, 0.1, 0.25), 0.9);
  double before = 0.1;
  for (double c = 0; c <= 0.25; c += 1.0 / 4096) {
    const double now = light_factor(c, 0.9, 0.1, 0.25);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.8 * kPi / 2 / 0.25 / 4096 + 1e-12) << "its steepest slope";
    before = now;
  }
  EXPECT_EQ(light_factor(1e-9, 1, 0.1, 0), 1) << "a step";
  EXPECT_EQ(light_factor(0, 1, 0.1, 0), 0.1);
}

}  // namespace
}  // namespace burnish
