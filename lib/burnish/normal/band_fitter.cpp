#include "burnish/normal/band_fitter.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"

namespace burnish {
namespace {

// atan on [0,1] to 2e-8 (Abramowitz & Stegun 4.4.49): for the report, where libm's would cost as much as the fit.
double arc_tangent(double x) {
  const double y = x * x;
  return x *
         (1 + y * (-0.3333314528 +
                   y * (0.1999355085 +
                        y * (-0.1420889944 +
                             y * (0.1065626393 + y * (-0.0752896400 +
                                                      y * (0.0429096138 + y * (-0.0161657367 + y * 0.0028662257))))))));
}

}  // namespace

BandFitter::BandFitter(const Neighborhood& neighborhood, const HeightMapOptions& options, int width, int height,
                       const NormalMapTarget& target, const std::string& name)
    : name_(name),
      n_(neighborhood),
      fit_u_(options.wrap_u == Wrap::kFit),
      fit_v_(options.wrap_v == Wrap::kFit),
      width_(width),
      height_(height),
      target_(target) {
  const double size_u = options.size_u > 0 ? options.size_u : width;
  const double size_v = options.size_v > 0 ? options.size_v : size_u * height / width;
  scale_u_ = options.height * width / size_u;
  scale_v_ = options.height * height / size_v;
}

NormalBand BandFitter::fit(const HeightBand& band) const {
  NormalBand out{band.first, band.rows, {}};
  const int r = n_.radius, stride = band.stride;
  std::vector<float> across;  // derivative along u of every row, for the neighbourhoods that smooth it along v
  if (n_.smoothing.size() > 1) {
    across.resize(std::size_t(band.rows + 2 * r) * width_);
    for (int p = 0; p < band.rows + 2 * r; p++)
      derivative_u(band.displacement.data() + std::size_t(p) * stride, across.data() + std::size_t(p) * width_);
  }
  const bool bytes = target_.sample == SampleType::kUint8, words = target_.sample == SampleType::kUint16;
  const std::size_t out_row = std::size_t(width_) * 3 * (bytes ? 1 : words ? 2 : 4);
  out.samples.resize(out_row * band.rows);
  std::vector<float> slope_u(width_), slope_v(width_), scratch(stride);
  std::vector<Vec3f> normals(width_);
  for (int y = 0; y < band.rows; y++) {
    const float* rows = band.displacement.data() + std::size_t(y) * stride;  // r rows above this one
    if (across.empty()) {
      derivative_u(rows + std::size_t(r) * stride, slope_u.data());
    } else {
      std::fill(slope_u.begin(), slope_u.end(), 0.f);
      for (int j = 0; j <= 2 * r; j++) {
        const float s = n_.smoothing[std::abs(j - r)];
        const float* in = across.data() + std::size_t(y + j) * width_;
        for (int x = 0; x < width_; x++) slope_u[x] += s * in[x];
      }
    }
    derivative_v(rows, stride, scratch.data(), slope_v.data());
    const float su = float(scale_u_), sv = float(scale_v_);
    for (int x = 0; x < width_; x++) {
      const float a = slope_u[x] * su, b = slope_v[x] * sv;
      const float z = 1.f / std::sqrt(a * a + b * b + 1.f);
      normals[x] = {-a * z, -b * z, z};
    }
    solve_incomplete(band, y, normals.data(), out);
    gather(band, y, normals.data(), out);
    encode_normals(normals.data(), width_, target_.coding, target_.sample, out.samples.data() + out_row * y);
  }
  return out;
}

void BandFitter::derivative_u(const float* padded, float* out) const {
  const float* in = padded + n_.radius;
  const float d1 = n_.derivative[1];
  for (int x = 0; x < width_; x++) out[x] = d1 * (in[x + 1] - in[x - 1]);
  for (int i = 2; i <= n_.radius; i++) {
    const float d = n_.derivative[i];
    for (int x = 0; x < width_; x++) out[x] += d * (in[x + i] - in[x - i]);
  }
}

// Differences first, smoothing after: what they subtract is exact, and large heights cost no precision.
void BandFitter::derivative_v(const float* rows, int stride, float* scratch, float* out) const {
  const int r = n_.radius;
  std::fill_n(scratch, stride, 0.f);
  for (int i = 1; i <= r; i++) {
    const float* above = rows + std::size_t(r - i) * stride;
    const float* below = rows + std::size_t(r + i) * stride;
    const float d = n_.derivative[i];
    for (int x = 0; x < stride; x++) scratch[x] += d * (above[x] - below[x]);
  }
  if (n_.smoothing.size() == 1) {
    std::copy_n(scratch + r, width_, out);
    return;
  }
  std::fill_n(out, width_, 0.f);
  for (int i = -r; i <= r; i++) {
    const float s = n_.smoothing[std::abs(i)];
    for (int x = 0; x < width_; x++) out[x] += s * scratch[x + r + i];
  }
}

// Texels whose neighbourhood is not whole: at borders that end the map, and beside masked texels.
void BandFitter::solve_incomplete(const HeightBand& band, int y, Vec3f* normals, NormalBand& out) const {
  const int r = n_.radius, row = band.first + y;
  const bool border_row = fit_v_ && (row < r || row >= height_ - r);
  if (!band.exists.empty() || border_row) {
    for (int x = 0; x < width_; x++) solve(band, x, y, normals, out);
  } else if (fit_u_) {
    for (int x = 0; x < std::min(r, width_); x++) solve(band, x, y, normals, out);
    for (int x = std::max(r, width_ - r); x < width_; x++) solve(band, x, y, normals, out);
  }
}

void BandFitter::solve(const HeightBand& band, int x, int y, Vec3f* normals, NormalBand& out) const {
  const int r = n_.radius;
  float displacement[81];
  bool exists[81], whole = true;
  for (std::size_t i = 0; i < n_.taps.size(); i++) {
    const int tx = x + n_.taps[i].x, ty = y - n_.taps[i].y, row = band.first + ty;
    const std::size_t at = std::size_t(ty + r) * band.stride + tx + r;
    displacement[i] = band.displacement[at];
    exists[i] = !(fit_u_ && (tx < 0 || tx >= width_)) && !(fit_v_ && (row < 0 || row >= height_)) &&
                (band.exists.empty() || band.exists[at]);
    whole = whole && exists[i];
  }
  if (whole) return;
  const bool takes_part = exists[n_.taps.size() / 2];
  const PlaneSlope slope = takes_part ? fit_plane(n_, displacement, exists) : PlaneSlope{};
  if (takes_part && !slope.determined) out.degenerate++;
  normals[x] = Vec3f(normalized(Vec3d{-slope.a0 * scale_u_, -slope.a1 * scale_v_, 1}));
}

void BandFitter::gather(const HeightBand& band, int y, const Vec3f* normals, NormalBand& out) const {
  const int r = n_.radius;
  const std::uint8_t* exists =
      band.exists.empty() ? nullptr : band.exists.data() + std::size_t(y + r) * band.stride + r;
  double sum = 0;
  float steepest = 0;
  std::size_t count = 0;
  for (int x = 0; x < width_; x++) {
    if (exists && !exists[x]) continue;
    const Vec3f n = normals[x];
    const float half = std::sqrt(n.x * n.x + n.y * n.y) / (1.f + n.z);  // tangent of half the angle, exact near 0 too
    sum += 2 * arc_tangent(half);
    steepest = std::max(steepest, half);
    count++;
  }
  if (!std::isfinite(sum))
    throw file_error(ErrorKind::kMalformed, name_,
                     "slopes are too steep for floating point: look at the height, the size and the map");
  out.tilt_sum += sum;
  out.steepest = std::max<double>(out.steepest, steepest);
  out.taking_part += count;
}

}  // namespace burnish
