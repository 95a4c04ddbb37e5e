#include <gtest/gtest.h>

#include "burnish/brdf/model_brdf.h"
#include "burnish/ptm/brdf/brdf_error.h"
#include "burnish/ptm/brdf/fit_brdf.h"
#include "burnish/ptm/brdf/light_cap.h"

namespace burnish {
namespace {

// What a function of light and view says, wherever both are above the surface.
template <typename F>
class Made final : public Brdf {
 public:
  explicit Made(F f) : f_(f) {}

 private:
  Vec3d reflected_above(Vec3d l, Vec3d v) const override { return f_(l, v); }
  F f_;
};

constexpr BrdfCoordinates kAll[] = {BrdfCoordinates::kHalfDifference, BrdfCoordinates::kLightView,
                                    BrdfCoordinates::kDifferenceHalf};

double centre(int i, int size) { return (2 * i + 1.0) / size - 1; }

std::vector<Vec3d> directions(int count) {
  std::vector<Vec3d> out;
  for (int i = 0; i < count; i++) {
    const double z = (i + 0.5) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    out.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return out;
}

TEST(BrdfCoordinates, FrameIsGramAndSchmidts) {
  for (const Vec3d h : directions(200)) {
    const HalfFrame f = half_frame(h);
    EXPECT_NEAR(length(f.t), 1, 1e-12);
    EXPECT_NEAR(dot(f.t, h), 0, 1e-12);
    EXPECT_NEAR(length(f.b - cross(h, f.t)), 0, 1e-12);
    EXPECT_GT(f.t.x, 0);  // keeps to T
    EXPECT_NEAR(f.t.x * h.z - f.t.z * h.x, dot(f.b, Vec3d{0, 1, 0}), 1e-12);
  }
  EXPECT_NEAR(length(half_frame({1, 0, 0}).t), 1, 1e-12);
}

TEST(BrdfCoordinates, ThreeReadings) {
  const Vec3d l = normalized(Vec3d{0.3, -0.2, 0.9}), v = normalized(Vec3d{-0.5, 0.1, 0.6}), h = normalized(l + v);
  const BrdfPlace a = brdf_place(BrdfCoordinates::kHalfDifference, l, v),
                  b = brdf_place(BrdfCoordinates::kLightView, l, v),
                  c = brdf_place(BrdfCoordinates::kDifferenceHalf, l, v);
  const auto is = [](BrdfPlace at, double x, double y, double u, double w) {
    return at.x == x && at.y == y && at.u == u && at.v == w;
  };
  EXPECT_TRUE(is(a, h.x, h.y, a.u, a.v));
  EXPECT_TRUE(is(b, v.x, v.y, l.x, l.y));
  EXPECT_TRUE(is(c, a.u, a.v, h.x, h.y));
  // L is rebuilt from its two cosines and its height over H's plane.
  const HalfFrame f = half_frame(h);
  EXPECT_NEAR(length(f.t * a.u + f.b * a.v + h * dot(l, h) - l), 0, 1e-12);
  // Exchanged, light and view lie on the other side of H.
  const BrdfPlace back = brdf_place(BrdfCoordinates::kHalfDifference, v, l);
  EXPECT_NEAR(std::hypot(back.u + a.u, back.v + a.v), 0, 1e-12);
}

TEST(LightCaps, PointsAreTheTexelsOwn) {
  std::vector<CapPoint> points;
  for (const BrdfCoordinates coordinates : kAll)
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.3, -0.2}, {-0.6, 0.7}, {0.0, 0.99}}) {
      LightCaps(coordinates, 16).points_at(x, y, points);
      // Of the third reading none may be left where light and view are nearly opposite.
      EXPECT_TRUE(!points.empty() || coordinates == BrdfCoordinates::kDifferenceHalf);
      for (const CapPoint& p : points) {
        const BrdfPlace at = brdf_place(coordinates, p.l, p.v);
        EXPECT_NEAR(std::hypot(at.x - x, at.y - y), 0, 1e-9) << name(coordinates);
        EXPECT_NEAR(std::hypot(at.u - p.u, at.v - p.w), 0, 1e-9) << name(coordinates);
        EXPECT_TRUE(p.l.z > 0 && p.v.z > 0);
        EXPECT_NEAR(length(p.l), 1, 1e-12);
      }
    }
}

TEST(LightCaps, SolidAnglesAreTheSeenPartOfTheHemisphere) {
  std::vector<CapPoint> points;
  for (const double tilt : {0.0, 0.2, 0.9, 1.5}) {
    LightCaps(BrdfCoordinates::kHalfDifference, 24).points_at(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, points);
    // Counted among directions over the hemisphere about H.
    const Vec3d h{std::sin(tilt), 0, std::cos(tilt)};
    std::size_t seen = 0;
    const auto all = directions(200000);
    for (const Vec3d d : all) {
      const Vec3d l{d.x * h.z + d.z * h.x, d.y, d.z * h.z - d.x * h.x}, v = h * (2 * dot(h, l)) - l;
      seen += l.z > 0 && v.z > 0;
    }
    double sum = 0, cosine = 0;
    for (const CapPoint& p : points) sum += p.solid_angle, cosine += p.solid_angle * dot(p.l, normalized(p.l + p.v));
    EXPECT_NEAR(sum, 2 * kPi * double(seen) / double(all.size()), 0.01);
    EXPECT_TRUE(tilt > 0 || std::abs(cosine - kPi) < 1e-3) << cosine;
  }
}

TEST(FitBrdf, PolynomialsOfLightComeBack) {
  // Coefficients that differ from half vector to half vector, and from colour to colour.
  const auto coefficients = [](double x, double y, int colour) {
    return PtmCoefficients<double>{0.1 + 0.2 * x, -0.1 * y, 0.05, 0.2 * y, 0.1 * colour, 0.5 + 0.3 * x * y};
  };
  const Made made([&](Vec3d l, Vec3d v) {
    const BrdfPlace at = brdf_place(BrdfCoordinates::kHalfDifference, l, v);
    Vec3d out;
    out.x = evaluate(coefficients(at.x, at.y, 0), at.u, at.v),
    out.y = evaluate(coefficients(at.x, at.y, 1), at.u, at.v);
    out.z = evaluate(coefficients(at.x, at.y, 2), at.u, at.v);
    return out;
  });
  const int size = 9;
  const Ptm ptm = fit_brdf(made, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, size});
  for (int y = 0; y < size; y++)
    for (int x = 0; x < size; x++) {
      const double r = std::hypot(centre(x, size), centre(y, size));
      if (r > 0.7) continue;
      for (int c = 0; c < 3; c++)
        for (int k = 0; k < kPtmTerms; k++)
          EXPECT_NEAR(ptm.coefficients[((std::size_t(y) * size + x) * 3 + c) * kPtmTerms + k] / 255,
                      coefficients(centre(x, size), centre(y, size), c)[k], r == 0 ? 1e-6 : 1e-2)
              << x << " " << y << " " << c << " " << k;
    }
}

// Independent of the quadrature: the mean of the fit's residual under evenly spread lights is 0, as that of any least
// squares with a constant term is, and so is its product with each term.
TEST(FitBrdf, ResidualsAreOrthogonalToTheTerms) {
  const auto gloss = model_brdf("blinn-phong:ax=0.8,ay=0.9,n=6,kd=0.2");
  const int size = 8, x = 4, y = 3;
  const Vec3d h{centre(x, size), centre(y, size),
                std::sqrt(1 - std::pow(centre(x, size), 2) - std::pow(centre(y, size), 2))};
  const Ptm ptm = fit_brdf(*gloss, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, size});
  const HalfFrame f = half_frame(h);
  PtmCoefficients<double> sums{};
  double scale = 0;
  for (const Vec3d d : directions(100000)) {
    const Vec3d l = f.t * d.x + f.b * d.y + h * d.z, v = h * (2 * dot(h, l)) - l;
    if (!(l.z > 0 && v.z > 0)) continue;
    const double off = ptm.lit(std::size_t(y) * size + x, float(d.x), float(d.y))[0] / 255 - gloss->reflected(l, v).x;
    const auto terms = ptm_terms(d.x, d.y);
    for (int k = 0; k < kPtmTerms; k++) sums[k] += terms[k] * off;
    scale += std::abs(off);
  }
  for (int k = 0; k < kPtmTerms; k++) EXPECT_LT(std::abs(sums[k]), 0.01 * scale) << k;
}

TEST(FitBrdf, AConstantIsOneInEveryReading) {
  const Made made([](Vec3d, Vec3d) { return Vec3d{0.25, 0.5, 1}; });
  for (const BrdfCoordinates coordinates : kAll) {
    const BrdfPtmError error =
        brdf_error(fit_brdf(made, {coordinates, LightWeights::kUniform, 32}), coordinates, 0.9, made);
    EXPECT_LT(error.relative, 0.02) << name(coordinates);
  }
}

TEST(FitBrdf, RowZeroIsTheLowEndOfB) {
  const Made made([](Vec3d l, Vec3d v) {
    const Vec3d h = normalized(l + v);
    return Vec3d{h.y > 0 ? 1.0 : 0.0, h.x > 0 ? 1.0 : 0.0, 0};
  });
  const Ptm ptm = fit_brdf(made, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, 8});
  EXPECT_NEAR(ptm.lit(1 * 8 + 4, 0, 0)[0], 0, 1e-3);
  EXPECT_NEAR(ptm.lit(6 * 8 + 4, 0, 0)[0], 255, 0.1);
  EXPECT_NEAR(ptm.lit(4 * 8 + 1, 0, 0)[1], 0, 1e-3);
  EXPECT_NEAR(ptm.lit(4 * 8 + 6, 0, 0)[1], 255, 0.1);
}

TEST(FitBrdf, TexelsOutsideTheDiscRepeatTheNearestInside) {
  const auto ward = model_brdf("ward:ax=0.2,ay=0.5");
  for (const int size : {2, 5, 16, 33}) {
    const Ptm ptm = fit_brdf(*ward, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, size});
    const auto at = [&](int x, int y) { return ptm.coefficients.data() + (std::size_t(y) * size + x) * 3 * kPtmTerms; };
    for (int y = 0; y < size; y++)
      for (int x = 0; x < size; x++) {
        if (std::hypot(centre(x, size), centre(y, size)) < 1) continue;
        double least = 1e9;
        bool same = false;
        for (int j = 0; j < size; j++)
          for (int i = 0; i < size; i++) {
            if (std::hypot(centre(i, size), centre(j, size)) >= 1) continue;
            const double d = std::hypot(i - x, j - y);
            if (d < least - 1e-9) least = d, same = false;
            if (d < least + 1e-9) same |= std::equal(at(x, y), at(x, y) + 3 * kPtmTerms, at(i, j));
          }
        EXPECT_TRUE(same) << x << " " << y << " of " << size;
      }
  }
}

TEST(FitBrdf, WardIsNearAndTheOtherReadingIsNot) {
  const auto ward = model_brdf("ward:ax=0.2,ay=0.5,ks=1");
  const auto relative = [&](BrdfCoordinates c) {
    return brdf_error(fit_brdf(*ward, {c, LightWeights::kUniform, 32}), c, 1, *ward).relative;
  };
  const double half = relative(BrdfCoordinates::kHalfDifference), other = relative(BrdfCoordinates::kDifferenceHalf);
  EXPECT_LT(half, 0.25);
  EXPECT_GT(other, 2 * half);
  EXPECT_GT(relative(BrdfCoordinates::kLightView), 2 * half);
}

TEST(FitBrdf, WeightsOfPixelsServePixelsBetter) {
  const auto ward = model_brdf("ward:ax=0.2,ay=0.5,ks=1");
  const auto relative = [&](LightWeights weights) {
    const BrdfCoordinates half = BrdfCoordinates::kHalfDifference;
    return brdf_error(fit_brdf(*ward, {half, weights, 32}), half, 1, *ward).relative;
  };
  EXPECT_LT(relative(LightWeights::kProjected), 0.6 * relative(LightWeights::kUniform));
}

// What leaves towards straight above per unit of light from everywhere, by the map and by the formula.
TEST(FitBrdf, KeepsTheEnergy) {
  const auto gloss = model_brdf("blinn-phong:ax=0.6,ay=0.9,n=8,kd=0.1");
  const int size = 64;
  const Ptm ptm = fit_brdf(*gloss, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, size});
  double formula = 0, map = 0;
  for (const Vec3d l : directions(20000)) {
    const BrdfPlace at = brdf_place(BrdfCoordinates::kHalfDifference, l, {0, 0, 1});
    const int x = std::min(size - 1, int((0.5 * at.x + 0.5) * size)),
              y = std::min(size - 1, int((0.5 * at.y + 0.5) * size));
    formula += gloss->reflected(l, {0, 0, 1}).x;
    map += ptm.lit(std::size_t(y) * size + x, float(at.u), float(at.v))[0] / 255;
  }
  EXPECT_NEAR(map / formula, 1, 0.02);
}

TEST(AsLrgb, OneColourComesBackWithAComponentOf255) {
  const Vec3d tint{0.5, 1, 0.1};
  const auto ward = model_brdf("ward:ax=0.4,ay=0.4,kd=0.1");
  const Made made([&](Vec3d l, Vec3d v) { return tint * ward->reflected(l, v).x; });
  const Ptm rgb = fit_brdf(made, {BrdfCoordinates::kHalfDifference, LightWeights::kUniform, 12}), lrgb = as_lrgb(rgb);
  ASSERT_EQ(lrgb.type, PtmType::kLrgb);
  for (std::size_t i = 0; i < rgb.texels(); i++) {
    EXPECT_FLOAT_EQ(*std::max_element(&lrgb.colour[3 * i], &lrgb.colour[3 * i] + 3), 255.f);
    for (int c = 0; c < 3; c++) {
      EXPECT_GE(lrgb.colour[3 * i + c], 0.f);
      EXPECT_NEAR(lrgb.lit(i, 0.3f, -0.4f)[c], rgb.lit(i, 0.3f, -0.4f)[c],
                  1e-3 * (1 + std::abs(rgb.lit(i, 0.3f, -0.4f)[c])));
    }
  }
}

TEST(AsLrgb, NothingReflectedIsBlackUnderAnyLight) {
  const Made black([](Vec3d, Vec3d) { return Vec3d{}; });
  const Ptm lrgb = as_lrgb(fit_brdf(black, {BrdfCoordinates::kLightView, LightWeights::kUniform, 4}));
  for (const float a : lrgb.coefficients) EXPECT_EQ(a, 0);
  for (const float c : lrgb.colour) EXPECT_EQ(c, 255);
}

// Lambert's k_d/π · n·l under even light has a mean square of (k_d/π)²/3.
TEST(BrdfError, OfABlackMapIsWhatIsReflected) {
  const auto matt = model_brdf("ward:ks=0,kd=0.6");
  const Made black([](Vec3d, Vec3d) { return Vec3d{}; });
  for (const BrdfCoordinates coordinates : kAll) {
    const BrdfPtmError error =
        brdf_error(fit_brdf(black, {coordinates, LightWeights::kUniform, 4}), coordinates, 1, *matt);
    EXPECT_NEAR(error.rms, 0.6 / kPi / std::sqrt(3), 1e-3);
    EXPECT_NEAR(error.relative, 1, 1e-6);
  }
}

}  // namespace
}  // namespace burnish
