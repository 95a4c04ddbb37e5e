#include "burnish/palette/dither.h"

#include <algorithm>

#include "burnish/palette/blue_noise.h"

namespace burnish {
namespace {

Vec3f tangential(Vec3f e, Vec3f n) { return e - n * dot(e, n); }

}  // namespace

ErrorDiffusion::ErrorDiffusion(std::span<const Vec3f> entries, std::span<const EntryRange* const> ranges, int width,
                               double amount)
    : entries_(entries), ranges_(ranges), width_(width), amount_(float(amount)), here_(width), below_(width) {}

void ErrorDiffusion::row(const Vec3f* normals, const std::uint16_t* region, const std::uint16_t* region_below,
                         std::uint16_t* out) {
  const int step = leftward_ ? -1 : 1;
  std::ranges::fill(below_, Vec3f{});
  for (int i = 0, x = leftward_ ? width_ - 1 : 0; i < width_; i++, x += step) {
    const Vec3f n = normals[x];
    const EntryRange& range = *ranges_[region[x]];
    const Vec3f wanted = n + tangential(here_[x], n);
    const int entry = range.first + range.nearest(wanted);
    out[x] = std::uint16_t(entry);
    const Vec3f error = tangential(wanted - entries_[entry], n) * amount_;
    const auto pass = [&](int to_x, const std::uint16_t* to_region, std::vector<Vec3f>& to, float share) {
      if (to_region && to_x >= 0 && to_x < width_ && to_region[to_x] == region[x]) to[to_x] += error * share;
    };
    pass(x + step, region, here_, 7 / 16.f);
    pass(x - step, region_below, below_, 3 / 16.f);
    pass(x, region_below, below_, 5 / 16.f);
    pass(x + step, region_below, below_, 1 / 16.f);
  }
  std::swap(here_, below_);
  leftward_ = !leftward_;
}

std::array<std::uint16_t, kOrderedSteps> ordered_entries(std::span<const Vec3f> entries, const EntryRange& range, Vec3f normal,
                                                         double amount) {
  std::array<std::uint16_t, kOrderedSteps> out;
  Vec3f error{};
  for (std::uint16_t& entry : out) {
    entry = std::uint16_t(range.first + range.nearest(normal + error * float(amount)));
    error += tangential(normal - entries[entry], normal);
  }
  std::ranges::sort(out);
  return out;
}

int ordered_step(int x, int y) {
  const int rank = blue_noise_tile()[(y % kBlueNoiseSide) * kBlueNoiseSide + x % kBlueNoiseSide];
  return rank * kOrderedSteps / (kBlueNoiseSide * kBlueNoiseSide);
}

}  // namespace burnish
