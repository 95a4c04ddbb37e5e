#include "burnish/ptm/brdf/fit_brdf.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"
#include "burnish/ptm/brdf/light_cap.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {
namespace {

constexpr int kPoints = 32;  // along each side of a cap
constexpr double kUnseen = 1e-4, kWhite = 255;

using Matrix6 = Eigen::Matrix<double, kPtmTerms, kPtmTerms>;
using Vector6 = Eigen::Matrix<double, kPtmTerms, 1>;
using Colours = Eigen::Matrix<double, kPtmTerms, 3>;

Matrix6 uniform_moments() {
  const auto g = uniform_normal_matrix();
  Matrix6 m;
  for (int r = 0; r < kPtmTerms; r++)
    for (int c = 0; c < kPtmTerms; c++) m(r, c) = g[r][c];
  return m;
}

double centre(int i, int size) { return (2 * i + 1.0) / size - 1; }
bool inside(int x, int y, int size) { return portable::hypot(centre(x, size), centre(y, size)) < 1; }

Colours fit_texel(const Brdf& brdf, LightWeights weights, const std::vector<CapPoint>& points,
                  const Matrix6& hemisphere) {
  Matrix6 seen = Matrix6::Zero(), normal = Matrix6::Zero();
  Colours right = Colours::Zero();
  for (const CapPoint& p : points) {
    const auto terms = ptm_terms(p.u, p.w);
    const Vector6 b = Eigen::Map<const Vector6>(terms.data());
    const Matrix6 product = b * b.transpose();
    const double weight = p.solid_angle * (weights == LightWeights::kProjected ? p.v.z : 1);
    const Vec3d f = brdf.reflected(p.l, p.v) * (kWhite * weight);
    seen += product * p.solid_angle;
    normal += product * weight;
    right += b * Eigen::RowVector3d(f.x, f.y, f.z);
  }
  normal += kUnseen * (2 * kPi * hemisphere - seen);
  return normal.ldlt().solve(right);
}

// The texel inside of the disc that is nearest to one outside of it; the first of several.
std::pair<int, int> nearest_inside(int x, int y, int size) {
  const double r = portable::hypot(centre(x, size), centre(y, size));
  const auto on_rim = [&](int i) { return int(std::floor((centre(i, size) / r + 1) * size / 2)); };
  std::pair<int, int> best;
  double least = HUGE_VAL;
  for (int j = std::max(0, on_rim(y) - 2); j <= std::min(size - 1, on_rim(y) + 2); j++)
    for (int i = std::max(0, on_rim(x) - 2); i <= std::min(size - 1, on_rim(x) + 2); i++) {
      const double d = portable::hypot(i - x, j - y);
      if (inside(i, j, size) && d < least) least = d, best = {i, j};
    }
  return best;
}

}  // namespace

Ptm fit_brdf(const Brdf& brdf, const BrdfPtmSettings& settings, const Progress& progress) {
  const int size = settings.size;
  const LightCaps caps(settings.coordinates, kPoints);
  const Matrix6 hemisphere = uniform_moments();
  Ptm ptm{{PtmType::kRgb, size, size}, {}, {}};
  constexpr int kOfTexel = 3 * kPtmTerms, kBand = 16;
  ptm.coefficients.resize(ptm.texels() * kOfTexel);
  const auto texel = [&](int x, int y) { return ptm.coefficients.data() + (std::size_t(y) * size + x) * kOfTexel; };
  for (int first = 0; first < size; first += kBand) {
    parallel_for(std::min(kBand, size - first), [&](std::size_t i) {
      const int y = first + int(i);
      std::vector<CapPoint> points;
      for (int x = 0; x < size; x++) {
        if (!inside(x, y, size)) continue;
        caps.points_at(centre(x, size), centre(y, size), points);
        const Colours a = fit_texel(brdf, settings.weights, points, hemisphere);
        std::copy_n(a.data(), kOfTexel, texel(x, y));  // a column a colour
      }
    });
    report_progress(progress, double(std::min(first + kBand, size)) / size);
  }
  parallel_for(size, [&](std::size_t y) {
    for (int x = 0; x < size; x++) {
      if (inside(x, int(y), size)) continue;
      const auto [from_x, from_y] = nearest_inside(x, int(y), size);
      std::copy_n(texel(from_x, from_y), kOfTexel, texel(x, int(y)));
    }
  });
  return ptm;
}

Ptm as_lrgb(const Ptm& rgb) {
  constexpr int kSteps = 64;
  const Matrix6 g = uniform_moments();
  Ptm out{{PtmType::kLrgb, rgb.width, rgb.height}, {}, {}};
  out.coefficients.resize(rgb.texels() * kPtmTerms);
  out.colour.resize(rgb.texels() * 3);
  parallel_for_chunks(rgb.texels(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) {
      const Colours a =
          Eigen::Map<const Eigen::Matrix<float, kPtmTerms, 3>>(rgb.coefficients.data() + i * 3 * kPtmTerms)
              .cast<double>();
      // Steps of the power method, each to the best colour that has no component below 0.
      const Eigen::Matrix3d m = a.transpose() * g * a;
      Eigen::Vector3d colour = Eigen::Vector3d::Ones();
      for (int step = 0; step < kSteps; step++) {
        const Eigen::Vector3d next = (m * colour).cwiseMax(0);
        if (!(next.maxCoeff() > 0)) break;
        colour = next / next.maxCoeff();
      }
      const Vector6 light = a * colour / colour.squaredNorm();
      for (int k = 0; k < kPtmTerms; k++) out.coefficients[i * kPtmTerms + k] = float(light[k]);
      for (int c = 0; c < 3; c++) out.colour[i * 3 + c] = float(kWhite * colour[c]);
    }
  });
  return out;
}

}  // namespace burnish
