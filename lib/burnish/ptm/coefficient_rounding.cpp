#include "burnish/ptm/coefficient_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "burnish/core/vector_math.h"
#include "burnish/ptm/lanes.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {
namespace {

using kernels::kLanes;
using kernels::Lanes;

constexpr int kMostByte = 255;
constexpr std::size_t kDirections = 16;
constexpr int kMostSweeps = 3;

using Matrix = std::array<PtmCoefficients<double>, kPtmTerms>;

double length2(const Matrix& h, const float (&d)[kPtmTerms]) {
  double sum = 0;
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) sum += d[i] * h[i][j] * d[j];
  return sum;
}

// The shortest vector of each class modulo 2 but 0, of those with coordinates from −2 to 2.
std::vector<CoefficientRounding::Direction> shortest_directions(const Matrix& h) {
  struct Shortest {
    double length2 = std::numeric_limits<double>::infinity();
    CoefficientRounding::Direction of{};
  };
  std::array<Shortest, 1 << kPtmTerms> classes;
  for (int code = 0; code < 15625 / 2; code++) {  // 5⁶; those behind the middle are the same, turned round
    CoefficientRounding::Direction d{};
    int odd = 0;
    for (int k = 0, rest = code; k < kPtmTerms; k++, rest /= 5) {
      d.step[k] = float(rest % 5 - 2);
      odd |= (rest % 5 & 1) << k;
    }
    const double l = length2(h, d.step);
    if (l > 0 && l < classes[odd].length2) classes[odd] = {l, d};
  }
  std::sort(classes.begin() + 1, classes.end(),
            [](const Shortest& a, const Shortest& b) { return a.length2 < b.length2; });
  std::vector<CoefficientRounding::Direction> out;
  for (std::size_t n = 1; n <= kDirections && std::isfinite(classes[n].length2); n++) {
    CoefficientRounding::Direction d = classes[n].of;
    for (int i = 0; i < kPtmTerms; i++) {
      double sum = 0;
      for (int j = 0; j < kPtmTerms; j++) sum += h[i][j] * d.step[j];
      d.slope[i] = float(sum / classes[n].length2);
    }
    out.push_back(d);
  }
  return out;
}

// Bytes less half their range, so that a magnitude says whether one is within it.
constexpr float kMiddle = kMostByte / 2.0f;

// z, in steps, to the nearest within the range that the directions lead to.
template <bool kWithin>
[[gnu::always_inline]] inline void nearest(const float (&feedback)[kPtmTerms][kPtmTerms],
                                           std::span<const CoefficientRounding::Direction> directions,
                                           const Lanes (&z)[kPtmTerms], Lanes (&byte)[kPtmTerms]) {
  Lanes error[kPtmTerms];  // byte − z
  for (int i = kPtmTerms - 1; i >= 0; i--) {
    Lanes wanted = z[i];
    for (int j = i + 1; j < kPtmTerms; j++) wanted -= feedback[i][j] * error[j];
    kernels::round(wanted);
    if (kWithin) {
      wanted = wanted < 0.0f ? wanted * 0.0f : wanted;
      wanted = wanted > float(kMostByte) ? wanted * 0.0f + float(kMostByte) : wanted;
    }
    byte[i] = wanted;
    error[i] = wanted - z[i];
  }
  for (int sweep = 0; sweep < kMostSweeps; sweep++) {
    Lanes moved = z[0] * 0.0f;
    for (const CoefficientRounding::Direction& d : directions) {
      Lanes n = -d.slope[0] * error[0];
      for (int k = 1; k < kPtmTerms; k++) n -= d.slope[k] * error[k];
      kernels::round(n);
      if (kWithin) {
        const Lanes none = n * 0.0f;
        for (int k = 0; k < kPtmTerms; k++) {
          const Lanes to = byte[k] + n * d.step[k];
          n = to < 0.0f ? none : to > float(kMostByte) ? none : n;
        }
      }
      for (int k = 0; k < kPtmTerms; k++) {
        byte[k] += n * d.step[k];
        error[k] += n * d.step[k];
      }
      moved += n * n;
    }
    float any = 0;
    for (int lane = 0; lane < kLanes; lane++) any += moved[lane];
    if (any == 0) break;
  }
}

// What a block of kLanes polynomials is rounded with.
struct Rounding {
  double scale[kPtmTerms], zero[kPtmTerms];  // what raw = 0 stands for
  float feedback[kPtmTerms][kPtmTerms];
  std::span<const CoefficientRounding::Direction> directions;
};

BURNISH_VECTOR_UNITS void round_block(const Rounding& with, const float* coefficients, std::uint8_t* raw) {
  float lanes[kPtmTerms][kLanes];
  for (int k = 0; k < kPtmTerms; k++)
    for (int lane = 0; lane < kLanes; lane++)
      lanes[k][lane] = float((coefficients[lane * kPtmTerms + k] - with.zero[k]) * with.scale[k]);
  Lanes z[kPtmTerms], byte[kPtmTerms];
  for (int k = 0; k < kPtmTerms; k++) kernels::load(lanes[k], z[k]);
  nearest<false>(with.feedback, with.directions, z, byte);
  Lanes beyond = z[0] * 0.0f;  // how far the furthest byte is from the middle
  for (int k = 0; k < kPtmTerms; k++) {
    const Lanes off = byte[k] - kMiddle, far = off < 0.0f ? -off : off;
    beyond = far > beyond ? far : beyond;
  }
  bool any = false;
  for (int lane = 0; lane < kLanes; lane++) any |= beyond[lane] > kMiddle;
  if (any) {
    Lanes within[kPtmTerms];
    nearest<true>(with.feedback, with.directions, z, within);
    for (int k = 0; k < kPtmTerms; k++) byte[k] = beyond > kMiddle ? within[k] : byte[k];
  }
  for (int k = 0; k < kPtmTerms; k++) kernels::store(byte[k], lanes[k]);
  for (int k = 0; k < kPtmTerms; k++)
    for (int lane = 0; lane < kLanes; lane++) raw[lane * kPtmTerms + k] = std::uint8_t(lanes[k][lane]);
}

}  // namespace

ByteRange byte_range(const PtmCoefficients<double>& least, const PtmCoefficients<double>& most) {
  ByteRange r;
  for (int k = 0; k < kPtmTerms; k++) {
    if (most[k] > least[k]) {
      r.scale[k] = (most[k] - least[k]) / kMostByte;
      // A bias beyond what integers hold needs a coarser scale.
      r.scale[k] = std::max(r.scale[k], std::max(std::abs(least[k]), std::abs(most[k])) / (1 << 24));
      r.bias[k] = int(std::lround(-least[k] / r.scale[k]));
    } else if (least[k] != 0) {
      r.scale[k] = std::abs(least[k]);
      r.bias[k] = least[k] < 0 ? 1 : 0;  // raw is 0, or 1
    }
  }
  return r;
}

CoefficientRounding::CoefficientRounding(const ByteRange& range,
                                         const std::array<PtmCoefficients<double>, kPtmTerms>& normal)
    : range_(range) {
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) h_[i][j] = range.scale[i] * normal[i][j] * range.scale[j];
  const std::array<Real, kPtmTerms> factor = upper_factor(h_);
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = i + 1; j < kPtmTerms; j++) feedback_[i][j] = float(factor[i][j] / factor[i][i]);
  directions_ = shortest_directions(h_);
}

void CoefficientRounding::round(const float* coefficients, std::size_t count, std::uint8_t* raw) const {
  Rounding with{{}, {}, {}, directions_};
  for (int k = 0; k < kPtmTerms; k++) {
    const double steps = 1 / range_.scale[k];
    with.scale[k] = std::isfinite(steps) ? steps : 0;  // where all bytes stand for 0, any will do
    with.zero[k] = -range_.bias[k] * range_.scale[k];
    std::copy_n(feedback_[k], kPtmTerms, with.feedback[k]);
  }
  constexpr std::size_t kBlock = std::size_t(kLanes) * kPtmTerms;
  std::size_t n = 0;
  for (; n + kLanes <= count; n += kLanes) round_block(with, coefficients + n * kPtmTerms, raw + n * kPtmTerms);
  if (n == count) return;
  // The last ones, in a block filled up with one of them.
  float rest[kBlock];
  std::uint8_t bytes[kBlock];
  for (std::size_t i = 0; i < kBlock; i++)
    rest[i] = coefficients[std::min(n + i / kPtmTerms, count - 1) * kPtmTerms + i % kPtmTerms];
  round_block(with, rest, bytes);
  std::copy_n(bytes, (count - n) * kPtmTerms, raw + n * kPtmTerms);
}

PtmCoefficients<std::uint8_t> CoefficientRounding::rounded(const PtmCoefficients<float>& a) const {
  PtmCoefficients<std::uint8_t> raw;
  round(a.data(), 1, raw.data());
  return raw;
}

double CoefficientRounding::squared_error(const PtmCoefficients<float>& a,
                                          const PtmCoefficients<std::uint8_t>& raw) const {
  Real error;
  for (int k = 0; k < kPtmTerms; k++) error[k] = raw[k] - (a[k] / range_.scale[k] + range_.bias[k]);
  double sum = 0;
  for (int i = 0; i < kPtmTerms; i++)
    for (int j = 0; j < kPtmTerms; j++) sum += error[i] * h_[i][j] * error[j];
  return sum;
}

}  // namespace burnish
