// How far a map strays from another: angles, gathered texel by texel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

class AngleStats {
 public:
  AngleStats() : bins_(kBins) {}
  void add(double rad, std::uint64_t texels = 1) {
    sum_ += rad * double(texels), squares_ += rad * rad * double(texels), texels_ += texels;
    max_ = std::max(max_, rad);
    bins_[bin(rad)] += texels;
  }
  AngleStats& operator+=(const AngleStats& o) {
    sum_ += o.sum_, squares_ += o.squares_, texels_ += o.texels_;
    max_ = std::max(max_, o.max_);
    for (std::size_t i = 0; i < kBins; i++) bins_[i] += o.bins_[i];
    return *this;
  }
  double rms_deg() const { return texels_ ? degrees(std::sqrt(squares_ / double(texels_))) : 0; }
  double mean_deg() const { return texels_ ? degrees(sum_ / double(texels_)) : 0; }
  double max_deg() const { return degrees(max_); }
  // The angle that 95 % of the texels do not exceed, to 1 part in 200 around 1°.
  double p95_deg() const {
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < kBins; i++)
      if (bins_[i] && (seen += bins_[i]) * 100 >= texels_ * 95) {
        const double t = double(i + 1) / kBins;
        return std::min(degrees(t * t * kPi), max_deg());
      }
    return 0;
  }

 private:
  static constexpr std::size_t kBins = 8192;  // evenly over √angle: fine where angles are small
  static std::size_t bin(double rad) { return std::min(kBins - 1, std::size_t(std::sqrt(rad / kPi) * kBins)); }
  double sum_ = 0, squares_ = 0, max_ = 0;
  std::uint64_t texels_ = 0;
  std::vector<std::uint64_t> bins_;
};

}  // namespace burnish
