#include "burnish/normal/height_map.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "burnish/core/error.h"
#include "burnish/normal/height_texels.h"
#include "burnish/normal/normal_space.h"

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

// A band of rows with what its texels' neighbourhoods need around it.
struct Band {
  int first = 0, rows = 0;
  int stride = 0;                    // width + 2·radius
  std::vector<float> displacement;   // (rows + 2·radius) × stride, of values in [0,1] or as the file has them
  std::vector<std::uint8_t> exists;  // same shape; empty where every texel does
  std::vector<std::byte> encoded;
  double tilt_sum = 0, steepest = 0;  // of angles; tangent of half the largest
  std::size_t taking_part = 0, degenerate = 0;
};

// Hands out bands from the top, holding no more rows than they need.
class BandSource {
 public:
  BandSource(const FileRef& file, const HeightMapOptions& options, int radius)
      : options_(options), radius_(radius), reader_(file), channel_(height_channel(reader_, options.channel)) {
    if (!options.mask.empty()) {
      mask_.emplace(options.mask);
      mask_->require_size(width(), height(), "the height map");
    }
    const std::size_t row_bytes = std::size_t(width()) * 4;
    // Multiples of 64 rows end where strips and tiles of the usual sizes end.
    band_rows_ = int(std::clamp<std::size_t>((2 << 20) / row_bytes / 64 * 64, 64, 4096));
    const bool whole_in_window = height() <= band_rows_ + radius_;
    if (options.wrap_v == Wrap::kRepeat && !whole_in_window) {  // the first band needs the last rows
      ImageReader again(file);
      std::optional<ImageReader> mask_again;
      if (mask_) mask_again.emplace(options.mask);
      for (int y = height() - radius_; y < height(); y++)
        tail_.push_back(read_row(again, mask_again ? &*mask_again : nullptr, y));
    }
  }

  int width() const { return reader_.width(); }
  int height() const { return reader_.height(); }
  int band_rows() const { return band_rows_; }
  bool integer() const { return reader_.integer(); }
  bool colour_channels_differ() const { return colours_differ_; }
  bool done() const { return next_ >= height(); }

  Band next() {
    Band band;
    band.first = next_;
    band.rows = std::min(band_rows_, height() - next_);
    band.stride = width() + 2 * radius_;
    advance_window(std::max(0, band.first - radius_), std::min(height(), band.first + band.rows + radius_));
    const std::size_t size = std::size_t(band.rows + 2 * radius_) * band.stride;
    band.displacement.resize(size);
    if (mask_) band.exists.resize(size);
    for (int p = 0; p < band.rows + 2 * radius_; p++) {
      const std::size_t at = std::size_t(p) * band.stride;
      fill_row(wrapped_texel(band.first - radius_ + p, height(), options_.wrap_v), band.displacement.data() + at,
               mask_ ? band.exists.data() + at : nullptr);
    }
    next_ += band.rows;
    return band;
  }

 private:
  struct Row {
    std::vector<float> displacement;
    std::vector<std::uint8_t> exists;  // empty without a mask
  };

  Row read_row(ImageReader& reader, ImageReader* mask, int y) {
    std::vector<Row> rows = read_rows(reader, mask, y, 1);
    return std::move(rows[0]);
  }

  std::vector<Row> read_rows(ImageReader& reader, ImageReader* mask, int first, int count) {
    const std::size_t w = width(), c = reader.channels();
    samples_.resize(w * c * count);
    reader.read_rows(first, count, samples_.data());
    std::vector<Row> rows(count);
    for (int y = 0; y < count; y++) {
      const float* in = samples_.data() + std::size_t(y) * w * c;
      Row& row = rows[y];
      row.displacement.resize(w);
      for (std::size_t x = 0; x < w; x++) row.displacement[x] = in[x * c + channel_];
      if (c >= 3 && options_.channel.empty() && !colours_differ_)
        for (std::size_t x = 0; x < w; x++)
          if (in[x * c] != in[x * c + 1] || in[x * c] != in[x * c + 2]) colours_differ_ = true;
      if (mask) {
        const std::size_t mc = mask->channels();
        mask_samples_.resize(w * mc);
        mask->read_rows(first + y, 1, mask_samples_.data());
        row.exists.resize(w);
        for (std::size_t x = 0; x < w; x++) row.exists[x] = mask_samples_[x * mc] != 0.f;
      }
      float bad = 0;
      for (std::size_t x = 0; x < w; x++) bad += row.displacement[x] - row.displacement[x];
      if (bad != 0) discard_or_refuse(reader, row, first + y);
    }
    return rows;
  }

  // Infinities and NaN are no obstacle where the mask says that there is nothing.
  void discard_or_refuse(const ImageReader& reader, Row& row, int y) const {
    for (std::size_t x = 0; x < row.displacement.size(); x++) {
      if (std::isfinite(row.displacement[x])) continue;
      if (row.exists.empty() || row.exists[x])
        throw file_error(ErrorKind::kMalformed, reader.name(),
                         "expected finite heights, got NaN or infinity at column " + std::to_string(x) + ", row " +
                             std::to_string(y) + " (--mask can exclude it)");
      row.displacement[x] = 0;
    }
  }

  void advance_window(int first, int end) {
    while (window_first_ < first && !window_.empty()) window_.erase(window_.begin()), window_first_++;
    const int have = window_first_ + int(window_.size());
    if (end <= have) return;
    std::vector<Row> fresh = read_rows(reader_, mask_ ? &*mask_ : nullptr, have, end - have);
    for (Row& row : fresh) {
      if (options_.wrap_v == Wrap::kRepeat && int(head_.size()) < radius_) head_.push_back(row);
      window_.push_back(std::move(row));
    }
  }

  const Row& row_at(int y) const {
    if (y >= window_first_ && y < window_first_ + int(window_.size())) return window_[y - window_first_];
    if (y < int(head_.size())) return head_[y];
    return tail_[y - (height() - int(tail_.size()))];
  }

  void fill_row(int y, float* displacement, std::uint8_t* exists) const {
    const int w = width();
    if (y < 0) {  // beyond the edge with Wrap::kFit: never used as a height
      std::fill_n(displacement, w + 2 * radius_, 0.f);
      if (exists) std::fill_n(exists, w + 2 * radius_, std::uint8_t(0));
      return;
    }
    const Row& row = row_at(y);
    std::memcpy(displacement + radius_, row.displacement.data(), sizeof(float) * w);
    if (exists) std::memcpy(exists + radius_, row.exists.data(), w);
    for (int i = 0; i < radius_; i++)
      for (const auto& [x, at] : {std::pair{i - radius_, i}, std::pair{w + i, radius_ + w + i}}) {
        const int from = wrapped_texel(x, w, options_.wrap_u);
        displacement[at] = from < 0 ? 0.f : row.displacement[from];
        if (exists) exists[at] = from < 0 ? 0 : row.exists[from];
      }
  }

  const HeightMapOptions& options_;
  int radius_;
  ImageReader reader_;
  int channel_;
  std::optional<ImageReader> mask_;
  int band_rows_ = 0, next_ = 0;
  int window_first_ = 0;
  std::vector<Row> window_, head_, tail_;
  std::vector<float> samples_, mask_samples_;
  bool colours_differ_ = false;
};

// Fits the planes of a band and encodes their normals.
class BandFitter {
 public:
  BandFitter(const Neighborhood& neighborhood, const HeightMapOptions& options, int width, int height,
             const NormalMapTarget& target)
      : n_(neighborhood),
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

  void fit(Band& band) const {
    const int r = n_.radius, stride = band.stride;
    std::vector<float> across;  // derivative along u of every row, for the neighbourhoods that smooth it along v
    if (n_.smoothing.size() > 1) {
      across.resize(std::size_t(band.rows + 2 * r) * width_);
      for (int p = 0; p < band.rows + 2 * r; p++)
        derivative_u(band.displacement.data() + std::size_t(p) * stride, across.data() + std::size_t(p) * width_);
    }
    const bool bytes = target_.sample == SampleType::kUint8, words = target_.sample == SampleType::kUint16;
    const std::size_t out_row = std::size_t(width_) * 3 * (bytes ? 1 : words ? 2 : 4);
    band.encoded.resize(out_row * band.rows);
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
      solve_incomplete(band, y, normals.data());
      gather(band, y, normals.data());
      encode_normals(normals.data(), width_, target_.coding, target_.sample, band.encoded.data() + out_row * y);
    }
  }

 private:
  void derivative_u(const float* padded, float* out) const {
    const float* in = padded + n_.radius;
    const float d1 = n_.derivative[1];
    for (int x = 0; x < width_; x++) out[x] = d1 * (in[x + 1] - in[x - 1]);
    for (int i = 2; i <= n_.radius; i++) {
      const float d = n_.derivative[i];
      for (int x = 0; x < width_; x++) out[x] += d * (in[x + i] - in[x - i]);
    }
  }

  // Differences first, smoothing after: what they subtract is exact, and large heights cost no precision.
  void derivative_v(const float* rows, int stride, float* scratch, float* out) const {
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
  void solve_incomplete(Band& band, int y, Vec3f* normals) const {
    const int r = n_.radius, row = band.first + y;
    const bool border_row = fit_v_ && (row < r || row >= height_ - r);
    if (!band.exists.empty() || border_row) {
      for (int x = 0; x < width_; x++) solve(band, x, y, normals);
    } else if (fit_u_) {
      for (int x = 0; x < std::min(r, width_); x++) solve(band, x, y, normals);
      for (int x = std::max(r, width_ - r); x < width_; x++) solve(band, x, y, normals);
    }
  }

  void solve(Band& band, int x, int y, Vec3f* normals) const {
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
    if (takes_part && !slope.determined) band.degenerate++;
    normals[x] = Vec3f(normalized(Vec3d{-slope.a0 * scale_u_, -slope.a1 * scale_v_, 1}));
  }

  void gather(Band& band, int y, const Vec3f* normals) const {
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
      throw Error(ErrorKind::kMalformed,
                  "slopes are too steep for floating point: look at the height, the size and the map");
    band.tilt_sum += sum;
    band.steepest = std::max<double>(band.steepest, steepest);
    band.taking_part += count;
  }

  const Neighborhood& n_;
  bool fit_u_, fit_v_;
  int width_, height_;
  const NormalMapTarget& target_;
  double scale_u_, scale_v_;
};

}  // namespace

HeightMapStats convert_height_map(const FileRef& file, const HeightMapOptions& options, const NormalMapTarget& target,
                                  const Progress& progress) {
  if (!std::isfinite(options.height)) throw Error(ErrorKind::kUsage, "height: expected a finite number");
  if (!std::isfinite(options.mid_level)) throw Error(ErrorKind::kUsage, "mid-level: expected a finite number");
  if (!(options.size_u >= 0 && options.size_v >= 0 && std::isfinite(options.size_u + options.size_v)))
    throw Error(ErrorKind::kUsage, "size: expected positive numbers");
  require_encodable(target.coding, target.sample, target.file.name);
  const Neighborhood neighborhood = make_neighborhood(options.neighbors, options.weights);
  BandSource source(file, options, neighborhood.radius);
  HeightMapStats stats;
  stats.width = source.width();
  stats.height = source.height();
  const BandFitter fitter(neighborhood, options, stats.width, stats.height, target);
  ImageWriter writer(target.file, target.type, target.sample, stats.width, stats.height, 3,
                     space_attributes(target.type, NormalSpace::kTangent));

  double tilt_sum = 0, steepest = 0;
  std::size_t taking_part = 0;
  const bool stored = target.sample == SampleType::kUint8 || target.sample == SampleType::kUint16;
  const auto read = [&](tbb::flow_control& flow) -> std::shared_ptr<Band> {
    if (source.done()) {
      flow.stop();
      return nullptr;
    }
    return std::make_shared<Band>(source.next());
  };
  const auto fit = [&](std::shared_ptr<Band> band) {
    fitter.fit(*band);
    return band;
  };
  const auto write = [&](const std::shared_ptr<Band>& band) {
    if (stored) writer.write_rows_stored(band->rows, band->encoded.data());
    else writer.write_rows(band->rows, reinterpret_cast<const float*>(band->encoded.data()));
    tilt_sum += band->tilt_sum;
    steepest = std::max(steepest, band->steepest);
    taking_part += band->taking_part;
    stats.degenerate_texels += band->degenerate;
    report_progress(progress, double(band->first + band->rows) / stats.height);
  };
  constexpr std::size_t kBandsInFlight = 4;
  tbb::parallel_pipeline(
      kBandsInFlight,
      tbb::make_filter<void, std::shared_ptr<Band>>(tbb::filter_mode::serial_in_order, read) &
          tbb::make_filter<std::shared_ptr<Band>, std::shared_ptr<Band>>(tbb::filter_mode::parallel, fit) &
          tbb::make_filter<std::shared_ptr<Band>, void>(tbb::filter_mode::serial_in_order, write));
  writer.close();
  stats.max_slope_deg = degrees(2 * std::atan(steepest));
  stats.mean_tilt_deg = taking_part ? degrees(tilt_sum / double(taking_part)) : 0;
  stats.colour_channels_differ = source.colour_channels_differ();
  return stats;
}

}  // namespace burnish
