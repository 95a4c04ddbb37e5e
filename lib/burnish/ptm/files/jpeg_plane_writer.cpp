#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/ptm/files/grey_jpeg.h"
#include "burnish/ptm/files/jpeg_planes.h"
#include "burnish/ptm/files/plane.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {
namespace {

using Real = PtmCoefficients<double>;

// The constant first: what it loses, the others can make up for.
constexpr std::array<int, kPtmTerms> kSequence{5, 0, 1, 2, 3, 4};

int step_of(int quality) {
  const double scale = quality < 50 ? 50.0 / quality : 2 - quality / 50.0;
  return std::clamp(int(16 * scale), 1, 255);
}

std::uint8_t nearest_byte(double x) { return std::uint8_t(std::clamp(std::floor(x + 0.5), 0.0, 255.0)); }

// share[k][j]: how much of the error of coefficient j, in steps of its bytes, one that comes after it takes on.
std::array<Real, kPtmTerms> error_shares(const Real& scale) {
  const std::array<Real, kPtmTerms> normal = uniform_normal_matrix();
  // The last to be written stands first, so that those before it in the sequence are behind it in its row.
  const auto term = [](int row) { return kSequence[kPtmTerms - 1 - row]; };
  Eigen::Matrix<double, kPtmTerms, kPtmTerms> h;
  for (int r = 0; r < kPtmTerms; r++)
    for (int c = 0; c < kPtmTerms; c++) h(r, c) = scale[term(r)] * normal[term(r)][term(c)] * scale[term(c)];
  h.diagonal().array() += h.trace() * 1e-12 + 1e-300;  // a scale may be 0
  const Eigen::Matrix<double, kPtmTerms, kPtmTerms> u = h.llt().matrixU();
  std::array<Real, kPtmTerms> share{};
  for (int r = 0; r < kPtmTerms; r++)
    for (int c = r + 1; c < kPtmTerms; c++) share[term(r)][term(c)] = -u(r, c) / u(r, r);
  return share;
}

class Writer {
 public:
  Writer(const PtmBytes& ptm, int step) : ptm_(ptm), step_(step), share_(error_shares(ptm.scale)), kept_(ptm) {
    const int n = ptm.polynomials() * kPtmTerms + ptm.colours();
    streams_.resize(n);
    const std::vector<Plane> kept = planes_of(kept_);
    const int terms = ptm.polynomials() * kPtmTerms;
    parallel_for(std::size_t(n - terms), [&](std::size_t i) { write(terms + i, kept[terms + i]); });
    parallel_for(std::size_t(ptm.polynomials()), [&](std::size_t p) {
      for (const int k : kSequence) {
        aim(int(p), k);
        write(p * kPtmTerms + k, kept[p * kPtmTerms + k]);
      }
    });
  }

  const std::vector<std::string>& streams() const { return streams_; }

 private:
  // Into a stream and back, to what a reader sees.
  void write(std::size_t i, const Plane& plane) {
    streams_[i] = encode_grey_jpeg(plane.width, plane.height, step_, [&](int y, std::uint8_t* row) {
      for (int x = 0; x < plane.width; x++) row[x] = plane.at(y, x);
    });
    decode_grey_jpeg(streams_[i], plane.width, plane.height, [&](int y, const std::uint8_t* row) {
      for (int x = 0; x < plane.width; x++) plane.at(y, x) = row[x];
    });
  }

  // What light must be multiplied by to be nearest to the same on the colour that was kept.
  double light_factor(std::size_t texel) const {
    if (ptm_.type == PtmType::kRgb) return 1;
    int both = 0, kept = 0;
    for (std::size_t c = texel * 3; c < texel * 3 + 3; c++) {
      both += ptm_.colour[c] * kept_.colour[c];
      kept += kept_.colour[c] * kept_.colour[c];
    }
    return kept > 0 ? double(both) / kept : 1;
  }

  // Sets the bytes of coefficient k, all those before it in the sequence being as they are read.
  void aim(int polynomial, int k) {
    const std::size_t stride = std::size_t(ptm_.polynomials()) * kPtmTerms;
    for (std::size_t t = 0; t < ptm_.texels(); t++) {
      const std::size_t at = t * stride + std::size_t(polynomial) * kPtmTerms;
      const double factor = light_factor(t);
      const auto wanted = [&](int j) { return (ptm_.coefficients[at + j] - ptm_.bias[j]) * factor + ptm_.bias[j]; };
      double raw = wanted(k);
      for (const int j : kSequence) {
        if (j == k) break;
        raw += share_[k][j] * (kept_.coefficients[at + j] - wanted(j));
      }
      kept_.coefficients[at + k] = nearest_byte(raw);
    }
  }

  const PtmBytes& ptm_;
  const int step_;
  const std::array<Real, kPtmTerms> share_;
  PtmBytes kept_;  // as read back
  std::vector<std::string> streams_;
};

}  // namespace

std::string jpeg_planes(const PtmBytes& ptm, int quality, const std::string& name) {
  if (ptm.width > kLargestJpegSide || ptm.height > kLargestJpegSide)
    throw file_error(ErrorKind::kUnsupported, name,
                     "JPEG planes hold sides up to " + std::to_string(kLargestJpegSide) + ", not " +
                         std::to_string(ptm.width) + "x" + std::to_string(ptm.height));
  const Writer writer(ptm, step_of(quality));
  const std::vector<std::string>& streams = writer.streams();
  const std::size_t n = streams.size();
  std::string text = std::to_string(quality) + "\n";
  const auto line = [&](auto&& value) {
    for (std::size_t i = 0; i < n; i++) text += std::to_string(value(i)) + (i + 1 < n ? " " : "\n");
  };
  const auto none = [](std::size_t) { return 0; };
  line(none), line(none), line(none);  // transforms, motion
  line([](std::size_t i) { return i; });
  line([](std::size_t) { return -1; });
  line([&](std::size_t i) { return streams[i].size(); });
  line(none);
  return std::accumulate(streams.begin(), streams.end(), std::move(text));
}

}  // namespace burnish
