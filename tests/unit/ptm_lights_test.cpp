#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "burnish/ptm/basis.h"
#include "burnish/ptm/light_list.h"
#include "burnish/ptm/light_matrix.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

std::vector<LitPhoto> read_back(const std::string& text) {
  const ScratchDir dir;
  const FileRef file = dir / "lights.lp";
  std::ofstream(file.path) << text;
  return read_light_list(file);
}

TEST(LightList, NamesMayHoldSpacesAndVectorsAnyLength) {
  const auto photos = read_back("\xef\xbb\xbf 2\r\n\r\nphoto 1.jpg 0 0 2\r\n  sub/b.png\t+3e0 -0 4\n");
  ASSERT_EQ(photos.size(), 2u);
  EXPECT_TRUE(photos[0].file.ends_with("/photo 1.jpg")) << photos[0].file;
  EXPECT_EQ(photos[0].light, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(photos[1].file.ends_with("/sub/b.png")) << photos[1].file;
  EXPECT_NEAR(length(photos[1].light - Vec3d{0.6, 0, 0.8}), 0, 1e-15);
}

TEST(LightList, RefusalsNameFileAndLine) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_ERROR(read_back(text), ErrorKind::kMalformed, why);
  };
  refused("", "lights.lp': expected the number of photos, got nothing");
  refused("a.jpg 0 0 1\n", "line 1: expected the number of photos");
  refused("-1\n", "line 1: expected the number of photos");
  refused("99999999\n", "line 1: expected the number of photos, up to 65536");
  refused("2\na.jpg 0 0 1\n", "expected 2 photos, as line 1 says, got 1");
  refused("1\na.jpg 0 0 1\nb.jpg 0 0 1\n", "line 3: expected no more than the 1 photos of line 1");
  refused("1\na.jpg 0 1\n", "line 2: expected a file name and three numbers, got 'a.jpg'");
  refused("1\n0 0 1\n", "line 2: expected a file name before three numbers, got none");
  refused("1\na.jpg 0 nan 1\n", "line 2: expected a file name and three numbers");
  refused("1\na.jpg 0 0 1e999\n", "line 2: expected a file name and three numbers");
  refused("1\na.jpg 0 0 0\n", "line 2: expected a direction, got a vector of no length");
  refused("1\na.jpg 1e308 0 1e308\n", "line 2: expected a direction, got a vector whose length no number holds");
  refused("1\na.jpg 1 0 -0.5\n", "line 2: expected a light above the surface, got z = -0.5");
  refused("2\na.jpg 0 0 1\n./a.jpg 0 1 1\n", "line 3: ");
  EXPECT_ERROR(read_light_list(FileRef("nothing.lp")), ErrorKind::kIo, "'nothing.lp'");
}

// Whatever bytes change, a list is read or refused.
TEST(LightList, DamagedListsAreErrorsAtMost) {
  std::string whole = "12\n";
  for (int i = 0; i < 12; i++) whole += "photo " + std::to_string(i) + ".jpg 0.1 -0." + std::to_string(i) + " 0.75\n";
  std::mt19937 random(3);
  int refused = 0, read = 0;
  for (int i = 0; i < 1000; i++) {
    std::string text = whole;
    for (unsigned n = random() % 3 + 1; n > 0; n--) text[random() % text.size()] = char(random());
    if (i % 10 == 0) text.resize(random() % text.size());
    try {
      for (const LitPhoto& photo : read_back(text)) EXPECT_NEAR(length(photo.light), 1, 1e-12) << text;
      read++;
    } catch (const Error& error) {
      EXPECT_EQ(int(error.kind()), int(ErrorKind::kMalformed)) << error.what();
      refused++;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(read, 100);
}

// Well spread over the upper half of the sphere.
std::vector<Vec3d> dome(int count) {
  std::vector<Vec3d> out;
  for (int i = 0; i < count; i++) {
    const double z = 0.2 + 0.79 * (i + 0.5) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    out.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return out;
}

TEST(LightMatrix, GivesBackKnownCoefficients) {
  const PtmCoefficients<double> a{-40, 25, 7, 60, -33, 120};
  for (const int count : {6, 12, 50}) {
    const std::vector<Vec3d> lights = dome(count);
    const LightMatrix m = light_matrix(lights, 0, "l.lp");
    for (int k = 0; k < kPtmTerms; k++) {
      double fitted = 0;
      for (int i = 0; i < count; i++) fitted += m.pseudo_inverse[i][k] * evaluate(a, lights[i].x, lights[i].y);
      EXPECT_NEAR(fitted, a[k], 1e-9) << count << " lights, term " << k;
    }
  }
}

TEST(LightMatrix, ARidgeIsTheRegularisedSolution) {
  const LightMatrix m = light_matrix(dome(20), 0.3, "l.lp");
  // (G + λI) P = Bᵀ
  for (std::size_t i = 0; i < m.terms.size(); i++)
    for (int r = 0; r < kPtmTerms; r++) {
      double sum = 0.3 * m.pseudo_inverse[i][r];
      for (int c = 0; c < kPtmTerms; c++) sum += m.normal[r][c] * m.pseudo_inverse[i][c];
      EXPECT_NEAR(sum, m.terms[i][r], 1e-12);
    }
}

// The means of products of terms over many directions, uniform in z and in angle.
TEST(LightMatrix, UniformLightsAreThoseOfTheHemisphere) {
  constexpr int kCount = 200000;
  std::array<PtmCoefficients<double>, kPtmTerms> sum{};
  for (int i = 0; i < kCount; i++) {
    const double z = (i + 0.5) / kCount, r = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
    const auto terms = ptm_terms(r * std::cos(angle), r * std::sin(angle));
    for (int j = 0; j < kPtmTerms; j++)
      for (int k = 0; k < kPtmTerms; k++) sum[j][k] += terms[j] * terms[k] / kCount;
  }
  const auto closed = uniform_normal_matrix();
  for (int j = 0; j < kPtmTerms; j++)
    for (int k = 0; k < kPtmTerms; k++) EXPECT_NEAR(closed[j][k], sum[j][k], 1e-5) << j << " " << k;
}

TEST(LightMatrix, TheFactorOfAMatrixMakesItAgain) {
  std::vector<Vec3d> ring;
  for (int i = 0; i < 30; i++) ring.push_back({0.6 * std::cos(i), 0.6 * std::sin(i), 0.8});
  const auto remade = [](const auto& g) {
    const auto r = upper_factor(g);
    double most = 0;
    for (int i = 0; i < kPtmTerms; i++)
      for (int j = 0; j < kPtmTerms; j++) {
        double sum = 0;
        for (int k = 0; k < kPtmTerms; k++) sum += r[k][i] * r[k][j];
        most = std::max(most, std::abs(sum - g[i][j]));
        EXPECT_TRUE(j >= i || r[i][j] == 0);
      }
    return most;
  };
  EXPECT_LT(remade(light_matrix(dome(20), 0, "l.lp").normal), 1e-12);
  EXPECT_LT(remade(light_matrix(ring, 0.01, "l.lp").normal), 1e-6);  // singular
  EXPECT_TRUE(std::isfinite(remade(std::array<PtmCoefficients<double>, kPtmTerms>{})));
}

TEST(LightMatrix, LightsThatDoNotDecideAreRefused) {
  const auto refused = [](const std::vector<Vec3d>& lights, const std::string& why) {
    EXPECT_ERROR(light_matrix(lights, 0, "l.lp"), ErrorKind::kMalformed, why);
  };
  refused(dome(5), "'l.lp': expected at least 6 lights for 6 coefficients, got 5");
  std::vector<Vec3d> repeated = dome(5);
  repeated.insert(repeated.end(), 5, repeated[0]);
  refused(repeated, "got 10 that determine no more than 5");
  std::vector<Vec3d> ring;  // u² + v² is constant
  for (int i = 0; i < 30; i++) ring.push_back({0.6 * std::cos(i), 0.6 * std::sin(i), 0.8});
  refused(ring, "got 30 that determine no more than 5");
  EXPECT_EQ(light_matrix(ring, 0.01, "l.lp").pseudo_inverse.size(), 30u);
}

}  // namespace
}  // namespace burnish
