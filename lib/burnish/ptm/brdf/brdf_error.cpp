#include "burnish/ptm/brdf/brdf_error.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

constexpr std::size_t kPairs = 1 << 16, kGrain = 1 << 10;

struct Sums {
  double error = 0, all = 0;
  Sums& operator+=(const Sums& s) { return error += s.error, all += s.all, *this; }
};

// Number i of the sequence, in [0,1)⁴: multiples of powers of 1/g, g⁵ = g + 1.
double sequence(std::size_t i, int dimension) {
  constexpr double kG = 1.1673039782614187;
  const double x = 0.5 + double(i + 1) / portable::pow(kG, dimension + 1);
  return x - std::floor(x);
}

Vec3d direction(double z, double turn) {
  const double r = std::sqrt(1 - z * z);
  return {r * portable::cos(2 * kPi * turn), r * portable::sin(2 * kPi * turn), z};
}

// Bilinear and clamped, at (x, y) of the texture from −1 to 1.
Vec3d looked_up(const Ptm& ptm, const BrdfPlace& at) {
  const auto along = [](double c, int n) { return std::clamp((0.5 * c + 0.5) * n - 0.5, 0.0, n - 1.0); };
  const double x = along(at.x, ptm.width), y = along(at.y, ptm.height);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, ptm.width - 1), y1 = std::min(y0 + 1, ptm.height - 1);
  const auto texel = [&](int column, int row) {
    const auto lit = ptm.lit(std::size_t(row) * ptm.width + column, float(at.u), float(at.v));
    return Vec3d{lit[0], lit[1], lit[2]};
  };
  const auto across = [&](int row) { return texel(x0, row) * (1 - (x - x0)) + texel(x1, row) * (x - x0); };
  return (across(y0) * (1 - (y - y0)) + across(y1) * (y - y0)) / 255.0;
}

}  // namespace

BrdfPtmError brdf_error(const Ptm& ptm, BrdfCoordinates coordinates, double noise_factor, const Brdf& brdf) {
  const Sums sums = parallel_sum<Sums>(kPairs, kGrain, [&](std::size_t begin, std::size_t end) {
    Sums s;
    for (std::size_t i = begin; i < end; i++) {
      const Vec3d l = direction(sequence(i, 0), sequence(i, 1)),
                  v = direction(std::sqrt(sequence(i, 2)), sequence(i, 3));
      BrdfPlace at = brdf_place(coordinates, l, v);
      at.x *= noise_factor, at.y *= noise_factor;
      const Vec3d wanted = brdf.reflected(l, v), off = looked_up(ptm, at) - wanted;
      s.error += dot(off, off), s.all += dot(wanted, wanted);
    }
    return s;
  });
  return {std::sqrt(sums.error / (3 * kPairs)), sums.all > 0 ? std::sqrt(sums.error / sums.all) : 0};
}

}  // namespace burnish
