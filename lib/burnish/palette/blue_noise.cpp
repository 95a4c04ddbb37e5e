#include "burnish/palette/blue_noise.h"

#include <cmath>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

constexpr int kSide = kBlueNoiseSide, kTexels = kSide * kSide;

// Which texels are set, and under what energy each lies: a sum of Gaussians, in integers so that ties are ties
// everywhere.
class Pattern {
 public:
  Pattern() : set_(kTexels), energy_(kTexels), kernel_(kTexels) {
    constexpr double kSigma = 1.9;
    for (int y = 0; y < kSide; y++)
      for (int x = 0; x < kSide; x++) {
        const double dx = x < kSide / 2 ? x : kSide - x, dy = y < kSide / 2 ? y : kSide - y;
        kernel_[y * kSide + x] = std::lround(portable::exp(-(dx * dx + dy * dy) / (2 * kSigma * kSigma)) * (1 << 20));
      }
  }
  bool is_set(int i) const { return set_[i]; }
  void change(int i, bool to) {
    set_[i] = to;
    const int cx = i % kSide, cy = i / kSide;
    for (int y = 0; y < kSide; y++)
      for (int x = 0; x < kSide; x++) {
        const long k = kernel_[((y - cy) & (kSide - 1)) * kSide + ((x - cx) & (kSide - 1))];
        energy_[y * kSide + x] += to ? k : -k;
      }
  }
  int tightest_cluster() const { return extreme(true); }
  int largest_void() const { return extreme(false); }

 private:
  int extreme(bool of_set) const {
    int best = -1;
    for (int i = 0; i < kTexels; i++)
      if (set_[i] == of_set && (best < 0 || (of_set ? energy_[i] > energy_[best] : energy_[i] < energy_[best])))
        best = i;
    return best;
  }
  std::vector<char> set_;
  std::vector<long> energy_, kernel_;
};

std::vector<std::uint16_t> make_tile() {
  Pattern pattern;
  int ones = 0;
  for (std::uint32_t seed = 1; ones < kTexels / 10;) {
    seed = seed * 1664525u + 1013904223u;
    if (const int i = int(seed >> 20); !pattern.is_set(i)) pattern.change(i, true), ones++;
  }
  for (;;) {  // spread them evenly
    const int from = pattern.tightest_cluster();
    pattern.change(from, false);
    const int to = pattern.largest_void();
    pattern.change(to, true);
    if (to == from) break;
  }
  std::vector<std::uint16_t> rank(kTexels);
  Pattern shrinking = pattern;
  for (int r = ones - 1; r >= 0; r--) {
    const int i = shrinking.tightest_cluster();
    shrinking.change(i, false);
    rank[i] = std::uint16_t(r);
  }
  for (int r = ones; r < kTexels; r++) {
    const int i = pattern.largest_void();
    pattern.change(i, true);
    rank[i] = std::uint16_t(r);
  }
  return rank;
}

}  // namespace

const std::vector<std::uint16_t>& blue_noise_tile() {
  static const std::vector<std::uint16_t> tile = make_tile();
  return tile;
}

}  // namespace burnish
