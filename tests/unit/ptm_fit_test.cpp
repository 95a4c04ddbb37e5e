#include <gtest/gtest.h>

#include <algorithm>

#include "burnish/ptm/files/ptm_file.h"
#include "burnish/ptm/fit/fit_ptm.h"
#include "burnish/ptm/round_ptm.h"
#include "expect_error.h"
#include "on_threads.h"
#include "ptm_capture_fixture.h"

namespace burnish {
namespace {

using testing::made_up_photos;
using testing::made_up_polynomial;
using testing::Samples;
using testing::ScratchDir;

constexpr int kWidth = 23, kHeight = 7;
constexpr std::size_t kMemory = 1 << 28;

// Photographs in files of floats, and the lights.
struct FloatCapture {
  ScratchDir dir;
  std::vector<Vec3d> lights;
  std::vector<FileRef> files;
  LightMatrix matrix;

  FloatCapture(const std::vector<Samples>& photos, const std::vector<Vec3d>& of, double ridge = 0)
      : lights(of), matrix(light_matrix(of, ridge, "l.lp")) {
    for (std::size_t i = 0; i < photos.size(); i++) {
      files.push_back(dir / (std::to_string(i) + ".exr"));
      testing::write_photo(files.back().path, FileType::kExr, SampleType::kFloat, kWidth, photos[i]);
    }
  }
  Capture capture() const { return {files, kMemory, dir.path()}; }
  PtmFit fit(const PtmFitOptions& options) const { return fit_ptm(capture(), matrix, options); }
};

Ptm whole(const PtmRows& rows) {
  Ptm out{rows.shape(), {}, {}};
  out.coefficients.resize(out.texels() * out.polynomials() * kPtmTerms);
  out.colour.resize(out.texels() * out.colours());
  rows.read(0, out.height, out.coefficients.data(), out.colour.data());
  return out;
}
Ptm fitted(const FloatCapture& capture, PtmFitOptions options) { return whole(*capture.fit(options).rows); }

PtmCoefficients<float> polynomial(const Ptm& ptm, std::size_t index) {
  PtmCoefficients<float> a;
  std::copy_n(ptm.coefficients.begin() + std::ptrdiff_t(index * kPtmTerms), kPtmTerms, a.begin());
  return a;
}

TEST(PtmFit, RecoversThePolynomialsOfExactPhotographs) {
  const auto lights = testing::dome_of_lights(50);
  const Ptm ptm = fitted(FloatCapture(made_up_photos(kWidth, kHeight, lights), lights), {.type = PtmType::kRgb});
  ASSERT_EQ(ptm.width, kWidth);
  ASSERT_EQ(ptm.height, kHeight);
  for (int y = 0; y < kHeight; y++)
    for (int x = 0; x < kWidth; x++)
      for (int c = 0; c < 3; c++) {
        const auto got = polynomial(ptm, (std::size_t(y) * kWidth + x) * 3 + c);
        const auto wanted = made_up_polynomial(x, y, c);
        for (int k = 0; k < kPtmTerms; k++)
          EXPECT_NEAR(got[k], wanted[k], 1e-5 * std::max(1.0, std::abs(wanted[k]))) << x << " " << y << " " << c << k;
      }
}

// A texel black in all photographs, and one whose blue is.
TEST(PtmFit, RecoversColourAndLight) {
  const auto lights = testing::dome_of_lights(50);
  const auto colour_of = [](int t) -> std::array<double, 3> {
    if (t == 5) return {0, 0, 0};
    return {60.0 + t, 255, t == 9 ? 0.0 : 200 - t * 0.7};
  };
  std::vector<Samples> photos;
  for (const Vec3d& l : lights) {
    Samples& s = photos.emplace_back();
    for (int t = 0; t < kWidth * kHeight; t++)
      for (const double c : colour_of(t)) s.push_back(float(c / 255 * evaluate(made_up_polynomial(t, 2, 1), l.x, l.y)));
  }
  const Ptm ptm = fitted(FloatCapture(photos, lights), {});
  for (int t = 0; t < kWidth * kHeight; t++) {
    const bool black = t == 5;
    const auto wanted = made_up_polynomial(t, 2, 1);
    for (int k = 0; k < kPtmTerms; k++)
      EXPECT_NEAR(polynomial(ptm, t)[k], black ? 0 : wanted[k], 1e-5 * std::max(1.0, std::abs(wanted[k]))) << t;
    for (int c = 0; c < 3; c++) EXPECT_NEAR(ptm.colour[t * 3 + c], black ? 255 : colour_of(t)[c], 1e-5 * 255) << t;
  }
}

// Of channels that are no multiples of each other: no other colour and light are nearer over the lights.
TEST(PtmFit, ColourTimesLightIsTheNearestThereIs) {
  const auto lights = testing::dome_of_lights(20);
  const auto photos = made_up_photos(kWidth, kHeight, lights);
  const FloatCapture capture(photos, lights);
  const Ptm ptm = fitted(capture, {});
  const auto error = [&](std::size_t t, const std::array<double, 3>& colour, const PtmCoefficients<double>& a) {
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); i++)
      for (int c = 0; c < 3; c++) {
        const double e = photos[i][t * 3 + c] - colour[c] / 255 * evaluate(a, lights[i].x, lights[i].y);
        sum += e * e;
      }
    return sum;
  };
  for (const std::size_t t : {std::size_t(0), std::size_t(77), ptm.texels() - 1}) {
    std::array<double, 3> colour;
    std::copy_n(ptm.colour.begin() + std::ptrdiff_t(t * 3), 3, colour.begin());
    EXPECT_EQ(*std::ranges::max_element(colour), 255);
    PtmCoefficients<double> a;
    std::ranges::copy(polynomial(ptm, t), a.begin());
    const double least = error(t, colour, a);
    for (const double d : {-0.5, 0.5}) {
      for (double& c : colour) {
        c += d;
        EXPECT_GT(error(t, colour, a), least) << t;
        c -= d;
      }
      for (double& term : a) {
        term += d;
        EXPECT_GT(error(t, colour, a), least) << t;
        term -= d;
      }
    }
  }
}

TEST(PtmFit, TheListSaysWhichPhotoIsWhich) {
  auto lights = testing::dome_of_lights(12);
  auto photos = made_up_photos(kWidth, kHeight, lights);
  const Ptm one = fitted(FloatCapture(photos, lights), {.type = PtmType::kRgb});
  std::rotate(lights.begin(), lights.begin() + 5, lights.end());
  std::rotate(photos.begin(), photos.begin() + 5, photos.end());
  const Ptm other = fitted(FloatCapture(photos, lights), {.type = PtmType::kRgb});
  for (std::size_t i = 0; i < one.coefficients.size(); i++)
    EXPECT_NEAR(one.coefficients[i], other.coefficients[i], 1e-4);
}

TEST(PtmFit, ARidgeShrinksAndAcceptsARing) {
  std::vector<Vec3d> ring;
  for (int i = 0; i < 16; i++) ring.push_back({0.6 * std::cos(i), 0.6 * std::sin(i), 0.8});
  const FloatCapture capture(made_up_photos(kWidth, kHeight, ring), ring, 1e-3);
  for (const PtmType type : {PtmType::kRgb, PtmType::kLrgb}) {
    const PtmFit fit = capture.fit({.type = type, .ridge = 1e-3});
    const double rmse = rms_error(*fit.rows, capture.capture(), capture.matrix);
    EXPECT_LT(rmse, type == PtmType::kRgb ? 0.1 : 5);
    EXPECT_GT(rmse, 1e-6);
    const PtmBytes bytes = rounded(*fit.rows, capture.matrix.normal);  // G is singular
    EXPECT_LT(rms_error(PtmInMemory(decoded(bytes)), capture.capture(), capture.matrix), rmse + 1);
  }
}

TEST(PtmFit, ErrorIsThatOfClippedValues) {
  const auto lights = testing::dome_of_lights(6);
  std::vector<Samples> photos(6, Samples(kWidth * kHeight * 3, 0.0f));
  photos[0].assign(photos[0].size(), 255);  // six lights for six terms: what is fitted is met
  const FloatCapture capture(photos, lights);
  Ptm ptm{{PtmType::kRgb, kWidth, kHeight}, std::vector<float>(kWidth * kHeight * 18), {}};
  for (std::size_t i = 5; i < ptm.coefficients.size(); i += 6) ptm.coefficients[i] = 300;
  // 255 against 255 once, and against 0 five times.
  EXPECT_NEAR(rms_error(PtmInMemory(ptm), capture.capture(), capture.matrix), 255 * std::sqrt(5.0 / 6), 1e-3);
  EXPECT_LT(rms_error(*capture.fit({.type = PtmType::kRgb}).rows, capture.capture(), capture.matrix), 1e-3);
}

// Photographs that polynomials do not explain.
std::vector<Samples> bent_photos(const std::vector<Vec3d>& lights) {
  auto photos = made_up_photos(kWidth, kHeight, lights);
  for (std::size_t i = 0; i < photos.size(); i++)
    for (std::size_t s = 0; s < photos[i].size(); s++) photos[i][s] += float(9 * std::sin(i * 1.7 + double(s)));
  return photos;
}

TEST(PtmFit, LeavingOneOutIsWhatRefitsSay) {
  const auto lights = testing::dome_of_lights(9);
  const auto photos = bent_photos(lights);
  const FloatCapture capture(photos, lights);
  const auto without = [](auto all, std::size_t i) {
    all.erase(all.begin() + std::ptrdiff_t(i));
    return all;
  };
  double rgb = 0, lrgb = 0;
  const Ptm all = fitted(capture, {});
  for (std::size_t i = 0; i < lights.size(); i++) {
    const Ptm rest = fitted(FloatCapture(without(photos, i), without(lights, i)), {.type = PtmType::kRgb});
    for (std::size_t t = 0; t < rest.texels(); t++) {
      const auto value = rest.lit(t, float(lights[i].x), float(lights[i].y));
      const float* q = all.colour.data() + t * 3;
      const double along = (q[0] * value[0] + q[1] * value[1] + q[2] * value[2]) /
                           (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);  // the light of the refit, its colour held
      for (int c = 0; c < 3; c++) {
        const auto error2 = [&](double v) { return std::pow(photos[i][t * 3 + c] - std::clamp(v, 0.0, 255.0), 2); };
        rgb += error2(value[c]);
        lrgb += error2(q[c] * along);
      }
    }
  }
  const double samples = 3.0 * kWidth * kHeight * lights.size();
  const auto left_out = [&](PtmType type) {
    return *capture.fit({.type = type, .leave_one_out = true}).leave_one_out_rmse;
  };
  EXPECT_NEAR(left_out(PtmType::kRgb), std::sqrt(rgb / samples), 1e-3);
  EXPECT_NEAR(left_out(PtmType::kLrgb), std::sqrt(lrgb / samples), 1e-3);
  EXPECT_FALSE(capture.fit({}).leave_one_out_rmse);
}

TEST(PtmFit, PhotographsThatNothingStandsInForAreNotLeftOut) {
  auto lights = testing::dome_of_lights(6);
  EXPECT_ERROR(FloatCapture(bent_photos(lights), lights).fit({.leave_one_out = true}), ErrorKind::kMalformed,
               "leave-one-out: expected a photograph that the others determine, got 6 that all are needed");
  // Of a light that is there twice, each stands in for the other.
  lights.push_back(lights[2]);
  auto photos = bent_photos(lights);
  for (std::size_t s = 0; s < photos[2].size(); s++) photos[6][s] = photos[2][s] + 4;
  const FloatCapture capture(photos, lights);
  EXPECT_NEAR(*capture.fit({.type = PtmType::kRgb, .leave_one_out = true}).leave_one_out_rmse, 4, 1e-2);
}

// Shadows over a third of the photographs of each texel, hard and of any depth, and highlights in some.
TEST(PtmFit, ShadowsAndHighlightsAreRejected) {
  const auto lights = testing::dome_of_lights(48);
  auto photos = made_up_photos(kWidth, kHeight, lights);
  for (std::size_t i = 0; i < photos.size(); i++)
    for (std::size_t t = 0; t < photos[i].size() / 3; t++)
      for (int c = 0; c < 3; c++) {
        float& v = photos[i][t * 3 + c];
        if ((i * 7 + t) % 3 == 0) v *= 0.1f + 0.05f * float((i + t) % 9);
        else if ((i * 5 + t) % 16 == 1) v = 255;
      }
  const FloatCapture capture(photos, lights);
  const auto off = [&](bool reject) {
    const Ptm ptm = fitted(capture, {.type = PtmType::kRgb, .reject_shadows = reject});
    double most = 0;
    for (std::size_t i = 0; i < lights.size(); i++)
      for (std::size_t t = 0; t < ptm.texels(); t++) {
        const int x = int(t) % kWidth, y = int(t) / kWidth;
        const double wanted = evaluate(made_up_polynomial(x, y, 1), lights[i].x, lights[i].y);
        most = std::max(most, std::abs(ptm.lit(t, float(lights[i].x), float(lights[i].y))[1] - wanted));
      }
    return most;
  };
  EXPECT_GT(off(false), 30);
  EXPECT_LT(off(true), 1.5);
}

// Where nothing is to be rejected nothing changes, and too few lights are all kept.
TEST(PtmFit, RejectingKeepsWhatThereIsToKeep) {
  for (const int count : {6, 40}) {
    const auto lights = testing::dome_of_lights(count);
    const FloatCapture capture(made_up_photos(kWidth, kHeight, lights), lights);
    const Ptm plain = fitted(capture, {}), robust = fitted(capture, {.reject_shadows = true});
    for (std::size_t i = 0; i < plain.coefficients.size(); i++)
      EXPECT_NEAR(robust.coefficients[i], plain.coefficients[i], 0.02) << count << " " << i;
  }
}

// With all weights 1 the leverages of texels are those of the list.
TEST(PtmFit, LeavingOneOutWithRejectionHoldsTheWeights) {
  const auto lights = testing::dome_of_lights(30);
  const FloatCapture capture(made_up_photos(kWidth, kHeight, lights), lights);
  EXPECT_LT(*capture.fit({.reject_shadows = true, .leave_one_out = true}).leave_one_out_rmse,
            1.05 * *capture.fit({.leave_one_out = true}).leave_one_out_rmse);
}

// Bytes of the file that photographs of 8 bits give.
std::string file_of(const std::vector<FileRef>& photos, const PtmFitOptions& options, const ScratchDir& dir) {
  const LightMatrix matrix = light_matrix(testing::dome_of_lights(int(photos.size())), 0, "l.lp");
  const Capture capture(photos, options.memory, dir.path());
  const PtmFit fit = fit_ptm(capture, matrix, options);
  write_ptm(dir / "out.ptm", rounded(*fit.rows, matrix.normal));
  return testing::bytes_of(dir / "out.ptm");
}

TEST(PtmFit, BytesDependOnNeitherMemoryNorThreadsNorTheWayPhotosAreRead) {
  const ScratchDir dir;
  const auto lights = testing::dome_of_lights(9);
  const int width = 131, height = 47;
  const auto photos = made_up_photos(width, height, lights);
  std::vector<FileRef> baseline, progressive;
  for (std::size_t i = 0; i < photos.size(); i++) {
    baseline.push_back(dir / ("b" + std::to_string(i) + ".jpg"));
    progressive.push_back(dir / ("p" + std::to_string(i) + ".jpg"));
    testing::write_jpeg(baseline.back().path, width, photos[i]);
    testing::write_jpeg(progressive.back().path, width, photos[i], true);
  }
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb})
    for (const bool robust : {false, true}) {
      PtmFitOptions options{.type = type, .reject_shadows = robust, .memory = kMemory, .directory = dir.path()};
      const std::string wanted = file_of(baseline, options, dir);
      EXPECT_EQ(file_of(progressive, options, dir), wanted);
      for (const int threads : {1, 2, 3})
        EXPECT_EQ(on_threads(threads, [&] { return file_of(baseline, options, dir); }), wanted) << threads;
      options.memory = 1;  // bands of a row, coefficients in a file
      EXPECT_EQ(file_of(baseline, options, dir), wanted);
      EXPECT_EQ(file_of(progressive, options, dir), wanted);
    }
  EXPECT_EQ(dir.entries(), 2 * photos.size() + 1);
}

}  // namespace
}  // namespace burnish
