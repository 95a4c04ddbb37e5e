// Lobes: their reflectance and its derivatives against the formulas, their moments, the fit.
#include <gtest/gtest.h>

#include "burnish/core/vector_math.h"
#include "burnish/material/mips/lobe.h"
#include "burnish/material/mips/lobe_fit.h"
#include "burnish/material/mips/lobe_kernels.h"
#include "burnish/material/mips/lobe_moments.h"
#include "expect_error.h"
#include "material_lobe_fixture.h"

namespace burnish {
namespace {

using enum MaterialModel;
constexpr AlphaRange kAnyAlpha{0.01, 10};

Vec3d direction(const float (&of)[3][PairBlock::kPairs], int i) { return Vec3d(Vec3f{of[0][i], of[1][i], of[2][i]}); }

std::vector<float> reflectance(MaterialModel model, const Lobe& lobe, const std::vector<PairBlock>& pairs) {
  std::vector<float> out(pairs.size() * PairBlock::kPairs);
  kernels::reflectance(model, lobe, pairs, out.data());
  return out;
}

void expect_near(MaterialModel model, const Lobe& a, const Lobe& b, double tolerance) {
  EXPECT_NEAR(length(a.frame.n - b.frame.n), 0, tolerance) << name(model);
  EXPECT_NEAR(length(a.frame.t - b.frame.t), 0, tolerance) << name(model);
  EXPECT_NEAR(a.alpha_x / b.alpha_x, 1, tolerance) << name(model);
  EXPECT_NEAR(a.alpha_y / b.alpha_y, 1, tolerance) << name(model);
  EXPECT_NEAR(a.k_s / b.k_s, 1, tolerance) << name(model);
}

TEST(VectorMath, ExponentialsAndLogarithms) {
  for (double x = -120; x <= 0; x += 0.0371)
    EXPECT_NEAR(kernels::exp2_of_negative(float(x)) / std::exp2(double(float(x))), 1, 5e-7) << x;
  EXPECT_EQ(kernels::exp2_of_negative(-1e9f), std::exp2(-125.0f));
  for (double x = 1e-9; x < 1e9; x *= 1.0931)
    EXPECT_NEAR(kernels::log2_of(float(x)), std::log2(double(float(x))), 4e-6) << x;
}

TEST(DirectionPairs, LieInTheirCapsAndSpreadEvenly) {
  Vec3d light, view;
  const std::vector<PairBlock> pairs = direction_pairs(64);
  for (const PairBlock& p : pairs)
    for (int i = 0; i < PairBlock::kPairs; i++) {
      const Vec3d l = direction(p.l, i), v = direction(p.v, i);
      EXPECT_NEAR(length(l), 1, 1e-6);
      EXPECT_NEAR(length(v), 1, 1e-6);
      EXPECT_GE(l.z, 0.3 - 1e-6);
      EXPECT_GE(v.z, std::cos(0.8) - 1e-6);
      EXPECT_NEAR(length(normalized(l + v) - direction(p.h, i)), 0, 1e-6);
      light += l, view += v;
    }
  // The mean over a cap of least cosine c is (0, 0, (1 + c)/2); of views that of cos(0.8 u²).
  EXPECT_NEAR(length(light / 1024.0 - Vec3d{0, 0, 0.65}), 0, 4e-3);
  EXPECT_NEAR(length(view / 1024.0 - Vec3d{0, 0, 0.937869}), 0, 4e-3);
}

TEST(LobeKernels, ReflectanceIsTheFormulas) {
  std::mt19937 random(1);
  const std::vector<PairBlock> pairs = direction_pairs(16);
  for (const MaterialModel model : kAllModels)
    for (int lobes = 0; lobes < 20; lobes++) {
      const Lobe o = random_lobe(model, random);
      const std::vector<float> got = reflectance(model, o, pairs);
      double most = 0;
      for (std::size_t i = 0; i < got.size(); i++) {
        const PairBlock& p = pairs[i / PairBlock::kPairs];
        const int j = int(i % PairBlock::kPairs);
        const double wanted = reference_reflectance(model, o, direction(p.l, j), direction(p.v, j));
        most = std::max(most, wanted);
        EXPECT_NEAR(got[i], wanted, 1e-4 * wanted + 1e-6) << name(model) << ", pair " << i;
      }
      EXPECT_GT(most, 0.05 * peak(model, o)) << name(model);
    }
}

// A frame turned by small angles about its own t, b and n.
LocalFrame turned(const LocalFrame& f, Vec3d by) {
  return *orthonormal_frame(f.n + f.t * by.y - f.b * by.x, f.t + f.b * by.z - f.n * by.y);
}

TEST(LobeKernels, SumsAreThoseOfTheDerivatives) {
  std::mt19937 random(2);
  const std::vector<PairBlock> pairs = direction_pairs(16);
  constexpr double kStep = 1e-3;
  for (const MaterialModel model : kAllModels) {
    const Lobe o = lobe_of(model, frame_of(0.1, -0.2, 0.5), 0.3, 0.5, 1), other = random_lobe(model, random);
    const std::vector<float> wanted = reflectance(model, other, pairs), g = reflectance(model, o, pairs);
    std::vector<std::vector<double>> d;
    for (int i = 0; i < kernels::kShape; i++) {
      std::vector<float> ends[2];
      for (int end : {0, 1}) {
        const double by = end ? kStep : -kStep;
        Lobe moved = o;
        if (i < 3) moved.frame = turned(o.frame, {i == 0 ? by : 0, i == 1 ? by : 0, i == 2 ? by : 0});
        else (i == 3 ? moved.alpha_x : moved.alpha_y) *= std::exp(by);
        ends[end] = reflectance(model, moved, pairs);
      }
      d.emplace_back(g.size());
      for (std::size_t p = 0; p < g.size(); p++) d[i][p] = (double(ends[1][p]) - ends[0][p]) / (2 * kStep);
    }
    std::vector<float> scale(g.size()), scaled(g.size());
    for (std::size_t p = 0; p < g.size(); p++) scale[p] = 0.5f + float(p % 7), scaled[p] = scale[p] * wanted[p];
    const kernels::LobeSums sums = kernels::lobe_sums(model, o, pairs, scale.data(), scaled.data());
    const auto sum = [&](const auto& a, const auto& b) {
      double total = 0;
      for (std::size_t p = 0; p < g.size(); p++) total += double(scale[p]) * scale[p] * a[p] * b[p];
      return total;
    };
    const double gg = sum(g, g), ww = sum(wanted, wanted);
    EXPECT_NEAR(sums.gg / gg, 1, 1e-5) << name(model);
    EXPECT_NEAR(sums.gw, sum(g, wanted), 1e-5 * std::sqrt(gg * ww)) << name(model);
    for (int i = 0; i < kernels::kShape; i++) {
      const double dd = sum(d[i], d[i]);
      EXPECT_EQ(dd > 0, i < 3 || model != kBanks) << name(model) << i;
      EXPECT_NEAR(sums.gd[i], sum(g, d[i]), 2e-3 * std::sqrt(gg * dd)) << name(model) << i;
      EXPECT_NEAR(sums.wd[i], sum(wanted, d[i]), 2e-3 * std::sqrt(ww * dd)) << name(model) << i;
      for (int j = 0; j <= i; j++)
        EXPECT_NEAR(sums.dd[i][j], sum(d[i], d[j]), 2e-3 * std::sqrt(dd * sum(d[j], d[j]))) << name(model) << i << j;
    }
  }
}

TEST(Lobe, TexelsOfEveryModelComeBack) {
  std::mt19937 random(3);
  for (const MaterialModel model : kAllModels) {
    const Lobe o = random_lobe(model, random);
    const Lobe back = lobe_at(textures_of(model, 1, 1, [&](int, int) { return o; }), 0, 0, 0);
    expect_near(model, back, o, 1e-5);
    EXPECT_NEAR(back.exponent, o.exponent, 1e-4);
  }
}

TEST(Lobe, TexelsThatAreNone) {
  const auto textures = [](const auto& spoil) {
    MaterialTextures m = textures_of(kWard, 2, 2, [](int, int) { return lobe_of(kWard, frame_of(0, 0), 0.2, 0.2); });
    spoil(m);
    return m;
  };
  const std::string frame = "column 1, row 0: expected t, b and n of some length";
  for (MaterialTexture MaterialTextures::*which : {&MaterialTextures::t, &MaterialTextures::b, &MaterialTextures::n})
    EXPECT_ERROR(
        lobe_at(textures([&](MaterialTextures& m) { std::fill_n((m.*which).levels[0].at(1, 0), 3, 0.f); }), 0, 1, 0),
        ErrorKind::kMalformed, frame);
  EXPECT_ERROR(
      lobe_at(textures([](MaterialTextures& m) { std::copy_n(m.n.levels[0].at(1, 0), 3, m.t.levels[0].at(1, 0)); }), 0,
              1, 0),
      ErrorKind::kMalformed, frame);
  EXPECT_ERROR(lobe_at(textures([](MaterialTextures& m) { m.n.levels[0].at(0, 1)[3] = -1; }), 0, 0, 1),
               ErrorKind::kMalformed, "column 0, row 1: expected k_s and N of at least 0");
  EXPECT_ERROR(lobe_at(textures([](MaterialTextures& m) { m.b.levels[0].at(0, 0)[1] = 1e8f; }), 0, 0, 0),
               ErrorKind::kMalformed, "column 0, row 0: expected alphas of at least 1e-6");
}

TEST(LobeMoments, OfOneLobeAreThatLobe) {
  std::mt19937 random(4);
  for (const MaterialModel model : kAllModels)
    for (int i = 0; i < 20; i++) {
      const Lobe o = random_lobe(model, random);
      expect_near(model, LobeMoments(model, o).lobe(model), o, 1e-6);
    }
}

// Normals tilted by ±θ about +v: α_x² = α² cos²θ + 2 sin²θ, and blinn-phong's variance α²/(N+4) grows alike.
TEST(LobeMoments, OfTwoSlopes) {
  for (const MaterialModel model : {kWard, kBlinnPhong}) {
    LobeMoments moments;
    const double slope = 0.3, s2 = slope * slope / (1 + slope * slope);
    const Lobe one = lobe_of(model, frame_of(slope, 0), 0.2, 0.3), two = lobe_of(model, frame_of(-slope, 0), 0.2, 0.3);
    moments.add(LobeMoments(model, one), 0.5);
    moments.add(LobeMoments(model, two), 0.5);
    const Lobe got = moments.lobe(model);
    const double unit = model == kWard ? 0.5 : 1 / 16.0;
    EXPECT_NEAR(length(got.frame.n - Vec3d{0, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(length(got.frame.t - Vec3d{1, 0, 0}), 0, 1e-12);
    EXPECT_NEAR(got.alpha_x * got.alpha_x, one.alpha_x * one.alpha_x * (1 - s2) + s2 / unit, 1e-9) << name(model);
    EXPECT_NEAR(got.alpha_y, one.alpha_y, 1e-9) << name(model);
    const double kept = model == kWard ? 1 : one.alpha_x / got.alpha_x;  // ward's k_s is the energy itself
    EXPECT_NEAR(got.k_s, 0.8 * kept, 1e-9) << name(model);
  }
}

TEST(LobeMoments, DarkLobesTurnNothing) {
  LobeMoments moments;
  moments.add(LobeMoments(kWard, lobe_of(kWard, frame_of(0.5, 0), 0.2, 0.2, 0)), 0.5);
  moments.add(LobeMoments(kWard, lobe_of(kWard, frame_of(-0.5, 0), 0.2, 0.2, 1)), 0.5);
  const Lobe o = moments.lobe(kWard);
  EXPECT_NEAR(length(o.frame.n - frame_of(-0.5, 0).n), 0, 1e-5);
  EXPECT_NEAR(o.k_s, 0.5, 1e-12);
}

TEST(LobeMoments, NormalsAndTangentsThatCancelOut) {
  LobeMoments moments;
  const LocalFrame up{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, down{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  for (const LocalFrame& f : {up, down}) moments.add(LobeMoments(kWard, lobe_of(kWard, f, 0.2, 0.2)), 0.5);
  const LocalFrame f = moments.lobe(kWard).frame;
  EXPECT_NEAR(length(f.n - Vec3d{0, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(length(f.t), 1, 1e-12);
  EXPECT_NEAR(dot(f.t, f.n), 0, 1e-12);
}

TEST(LobeMoments, TurnsTowardsATangent) {
  const Lobe o = lobe_of(kWard, frame_of(0, 0), 0.1, 0.4);
  for (const Vec3d tangent : {Vec3d{1, 0.2, 0}, Vec3d{-1, 0.2, 0}, Vec3d{0.3, 1, 0}, Vec3d{0.3, -1, 0}}) {
    const Lobe turned = turned_towards(kWard, o, tangent);
    EXPECT_GT(dot(turned.frame.t, normalized(tangent)), 0.7);
    EXPECT_EQ(turned.alpha_x, std::abs(tangent.x) > 0.5 ? 0.1 : 0.4);
    EXPECT_NEAR(length(cross(turned.frame.n, turned.frame.t) - turned.frame.b), 0, 1e-12);
  }
  EXPECT_EQ(turned_towards(kBanks, o, {0.3, -1, 0}).frame.t, (Vec3d{1, 0, 0}));
}

TEST(LobeFit, FindsALobeFromAnotherNearby) {
  std::mt19937 random(5);
  const std::vector<PairBlock> pairs = direction_pairs(64);
  for (const MaterialModel model : kAllModels)
    for (int i = 0; i < 20; i++) {
      const Lobe wanted = random_lobe(model, random);
      Lobe start = wanted;
      start.frame = turned(wanted.frame, {0.05, -0.07, 0.2});
      if (model != kBanks) start.alpha_x *= 1.3, start.alpha_y *= 0.8;
      start.k_s *= 1.5;
      const AlphaRange range = model == kBanks ? AlphaRange{1, 1} : kAnyAlpha;
      const LobeFit fit = fit_lobe(model, pairs, reflectance(model, wanted, pairs).data(), start, range);
      // What holds a fit to its start leaves a trace.
      EXPECT_NEAR(length(fit.lobe.frame.n - wanted.frame.n), 0, 0.02) << name(model) << i;
      EXPECT_NEAR(fit.lobe.k_s / wanted.k_s, 1, 0.05) << name(model) << i;
      EXPECT_NEAR(fit.lobe.alpha_x / wanted.alpha_x, 1, 0.05) << name(model) << i;
      EXPECT_NEAR(fit.lobe.alpha_y / wanted.alpha_y, 1, 0.05) << name(model) << i;
    }
}

TEST(LobeFit, StaysWhereItIsRight) {
  std::mt19937 random(6);
  const std::vector<PairBlock> pairs = direction_pairs(16);
  for (const MaterialModel model : kAllModels)
    for (int i = 0; i < 20; i++) {
      const Lobe o = random_lobe(model, random);
      const LobeFit fit = fit_lobe(model, pairs, reflectance(model, o, pairs).data(), o, kAnyAlpha);
      expect_near(model, fit.lobe, o, 1e-5);
    }
}

TEST(LobeFit, StaysWhereNoPairSeesTheLobe) {
  const std::vector<PairBlock> pairs = direction_pairs(16);
  const Lobe o = lobe_of(kWard, frame_of(0.1, 0.1), 1e-3, 1e-3);
  std::vector<float> wanted = reflectance(kWard, o, pairs);
  EXPECT_LT(*std::ranges::max_element(wanted), 1e-3 * peak(kWard, o));
  expect_near(kWard, fit_lobe(kWard, pairs, wanted.data(), o, {1e-4, 10}).lobe, o, 1e-3);
}

TEST(LobeFit, KeepsAlphaInItsRangeAndBlackLobesBlack) {
  const std::vector<PairBlock> pairs = direction_pairs(16);
  const Lobe narrow = lobe_of(kWard, frame_of(0, 0), 0.1, 0.4), start = lobe_of(kWard, frame_of(0, 0), 0.2, 0.3);
  const std::vector<float> wanted = reflectance(kWard, narrow, pairs);
  const Lobe got = fit_lobe(kWard, pairs, wanted.data(), start, {0.15, 0.35}).lobe;
  EXPECT_EQ(got.alpha_x, 0.15);
  EXPECT_EQ(got.alpha_y, 0.35);
  Lobe black = start;
  black.k_s = 0;
  const std::vector<float> nothing(wanted.size());
  const LobeFit dark = fit_lobe(kWard, pairs, nothing.data(), black, kAnyAlpha);
  EXPECT_EQ(dark.lobe.k_s, 0);
  EXPECT_EQ(dark.lobe.alpha_x, 0.2);
  EXPECT_EQ(dark.error_square, 0);
}

// The error is the sum it is said to be, and no neighbour of the fit has less.
TEST(LobeFit, IsALeastSquare) {
  std::mt19937 random(7);
  const std::vector<PairBlock> pairs = direction_pairs(24);
  for (const MaterialModel model : kAllModels) {
    LobeMoments moments;
    std::vector<float> wanted(pairs.size() * PairBlock::kPairs);
    for (int i = 0; i < 4; i++) {
      const Lobe o = lobe_of(model, frame_of(0.2 * (i & 1), 0.15 * (i >> 1), 0.2 * i), 0.2, 0.3);
      moments.add(LobeMoments(model, o), 0.25);
      const std::vector<float> one = reflectance(model, o, pairs);
      for (std::size_t p = 0; p < wanted.size(); p++) wanted[p] += one[p] / 4;
    }
    const Lobe start = moments.lobe(model);
    const auto error = [&](const Lobe& o, bool weighted = true) {
      const std::vector<float> got = reflectance(model, o, pairs);
      double sum = 0;
      for (std::size_t p = 0; p < got.size(); p++) {
        const double off = double(got[p]) - wanted[p];
        sum += off * off / (weighted ? std::sqrt(wanted[p] / peak(model, start) + 0.05) : 1);
      }
      return sum;
    };
    const LobeFit fit = fit_lobe(model, pairs, wanted.data(), start, model == kBanks ? AlphaRange{1, 1} : kAnyAlpha);
    EXPECT_NEAR(fit.error_square / error(fit.lobe, false), 1, 1e-6) << name(model);
    EXPECT_LT(error(fit.lobe), model == kBanks ? error(start) : 0.8 * error(start)) << name(model);
    for (int i = 0; i < 50; i++) {
      std::uniform_real_distribution<double> by(-0.05, 0.05);
      Lobe near = fit.lobe;
      near.frame = turned(near.frame, {by(random), by(random), by(random)});
      if (model != kBanks) near.alpha_x *= 1 + by(random), near.alpha_y *= 1 + by(random);
      near.k_s *= 1 + by(random);
      EXPECT_GT(error(near), 0.99 * error(fit.lobe)) << name(model);
    }
  }
}

}  // namespace
}  // namespace burnish
