#include "burnish/normal/band_fitter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/normal/row_kernels.h"

namespace burnish {

// What is worked on of a row at once: it stays near the processor.
struct BandFitter::Block {
  static constexpr int kTexels = 512;

  int first, count;  // columns
  alignas(64) float slope_u[kTexels];
  alignas(64) float slope_v[kTexels];
  alignas(64) float x[kTexels];
  alignas(64) float y[kTexels];
  alignas(64) float z[kTexels];
  alignas(64) float tangents[kTexels];  // of half the angles to z
  alignas(64) Vec3f normals[kTexels];
};

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
  NormalBand out;
  out.first = band.first, out.rows = band.rows;
  const int r = n_.radius, stride = band.stride;
  std::vector<float> across;  // derivative along u of every row, for the neighbourhoods that smooth it along v
  if (n_.smoothing.size() > 1) {
    across.resize(std::size_t(band.rows + 2 * r) * width_);
    for (int p = 0; p < band.rows + 2 * r; p++)
      derivative_u(band.displacement.data() + std::size_t(p) * stride + r, width_,
                   across.data() + std::size_t(p) * width_);
  }
  const bool bytes = target_.sample == SampleType::kUint8, words = target_.sample == SampleType::kUint16;
  const std::size_t out_texel = 3 * (bytes ? 1 : words ? 2 : 4);
  out.samples = std::make_unique_for_overwrite<std::byte[]>(out_texel * width_ * band.rows);
  const bool as_they_are = !is_integer(target_.sample) && !is_biased(target_.coding.encoding, false) &&
                           target_.coding.green == GreenAxis::kUp;
  const auto block = std::make_unique_for_overwrite<Block>();
  for (int y = 0; y < band.rows; y++) {
    double tilt_sum = 0;
    for (int x = 0; x < width_; x += Block::kTexels) {
      block->first = x, block->count = std::min(Block::kTexels, width_ - x);
      const float* rows = band.displacement.data() + std::size_t(y) * stride + x;  // r rows above these texels
      if (across.empty()) derivative_u(rows + std::size_t(r) * stride + r, block->count, block->slope_u);
      else smooth_u(across.data() + std::size_t(y) * width_ + x, block->count, block->slope_u);
      derivative_v(rows, stride, block->count, block->slope_v);
      kernels::normals_of_slopes(block->slope_u, block->slope_v, float(scale_u_), float(scale_v_), block->count,
                                 {block->x, block->y, block->z}, block->tangents);
      solve_incomplete(band, y, *block, out);
      const kernels::Tilts tilts = kernels::tilts(block->tangents, block->count);
      tilt_sum += tilts.sum;
      out.steepest = std::max<double>(out.steepest, tilts.steepest);
      std::byte* to = out.samples.get() + out_texel * (std::size_t(y) * width_ + x);
      Vec3f* normals = as_they_are ? reinterpret_cast<Vec3f*>(to) : block->normals;
      kernels::interleave({block->x, block->y, block->z}, block->count, normals);
      if (!as_they_are) encode_normals(normals, block->count, target_.coding, target_.sample, to);
    }
    if (!std::isfinite(tilt_sum))
      throw file_error(ErrorKind::kMalformed, name_,
                       "slopes are too steep for floating point: look at the height, the size and the map");
    out.tilt_sum += tilt_sum;
    const std::uint8_t* exists = band.exists.empty() ? nullptr : band.exists.data() + std::size_t(y + r) * stride + r;
    if (!exists) out.taking_part += width_;
    else out.taking_part += std::size_t(width_ - std::count(exists, exists + width_, std::uint8_t(0)));
  }
  return out;
}

void BandFitter::derivative_u(const float* in, int count, float* out) const {
  kernels::differences(in + 1, in - 1, n_.derivative[1], count, out);
  for (int i = 2; i <= n_.radius; i++) kernels::add_differences(in + i, in - i, n_.derivative[i], count, out);
}

void BandFitter::smooth_u(const float* across, int count, float* out) const {
  const int r = n_.radius;
  std::fill_n(out, count, 0.f);
  for (int j = 0; j <= 2 * r; j++)
    kernels::add_scaled(across + std::size_t(j) * width_, n_.smoothing[std::abs(j - r)], count, out);
}

// Differences first, smoothing after: what they subtract is exact, and large heights cost no precision.
void BandFitter::derivative_v(const float* rows, int stride, int count, float* out) const {
  const int r = n_.radius;
  const auto differences = [&](int margin, float* to) {  // of the texels, and so many more on either side
    for (int i = 1; i <= r; i++) {
      const float* above = rows + std::size_t(r - i) * stride + r - margin;
      const float* below = rows + std::size_t(r + i) * stride + r - margin;
      if (i == 1) kernels::differences(above, below, n_.derivative[i], count + 2 * margin, to);
      else kernels::add_differences(above, below, n_.derivative[i], count + 2 * margin, to);
    }
  };
  if (n_.smoothing.size() == 1) return differences(0, out);
  float unsmoothed[Block::kTexels + 2 * kMostRadius];
  differences(r, unsmoothed);
  std::fill_n(out, count, 0.f);
  for (int i = 0; i <= 2 * r; i++) kernels::add_scaled(unsmoothed + i, n_.smoothing[std::abs(i - r)], count, out);
}

// Texels whose neighbourhood is not whole: at borders that end the map, and beside masked texels.
void BandFitter::solve_incomplete(const HeightBand& band, int y, Block& block, NormalBand& out) const {
  const int r = n_.radius, row = band.first + y, end = block.first + block.count;
  const bool border_row = fit_v_ && (row < r || row >= height_ - r);
  if (!band.exists.empty() || border_row) {
    for (int x = block.first; x < end; x++) solve(band, x, y, block, out);
  } else if (fit_u_) {
    const int left = std::min(r, width_);
    for (int x = block.first; x < std::min(left, end); x++) solve(band, x, y, block, out);
    for (int x = std::max({block.first, left, width_ - r}); x < end; x++) solve(band, x, y, block, out);
  }
}

void BandFitter::solve(const HeightBand& band, int x, int y, Block& block, NormalBand& out) const {
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
  const Vec3d n = normalized(Vec3d{-slope.a0 * scale_u_, -slope.a1 * scale_v_, 1});
  const int at = x - block.first;
  block.x[at] = float(n.x), block.y[at] = float(n.y), block.z[at] = float(n.z);
  block.tangents[at] = float(std::sqrt(n.x * n.x + n.y * n.y) / (1 + n.z));
}

}  // namespace burnish
