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
    pass(x + step, region, here_, 0.5f);
    pass(x, region_below, below_, 0.25f);
    pass(x - step, region_below, below_, 0.25f);
  }
  std::swap(here_, below_);
  leftward_ = !leftward_;
}

namespace {

struct Share {
  int dx, dy;
  float weight;
};

struct DotOrder {
  std::vector<std::uint16_t> texel;       // of each rank: y · side + x
  std::vector<std::vector<Share>> share;  // of each texel of the tile: where its error goes
};

DotOrder make_dot_order() {
  const std::vector<std::uint16_t>& rank = blue_noise_tile();
  constexpr int kSide = kBlueNoiseSide, kReach = 2;
  DotOrder order{std::vector<std::uint16_t>(rank.size()), std::vector<std::vector<Share>>(rank.size())};
  for (int y = 0; y < kSide; y++)
    for (int x = 0; x < kSide; x++) {
      const int at = y * kSide + x;
      order.texel[rank[at]] = std::uint16_t(at);
      float total = 0;
      for (int dy = -kReach; dy <= kReach; dy++)
        for (int dx = -kReach; dx <= kReach; dx++) {
          if (rank[((y + dy) & (kSide - 1)) * kSide + ((x + dx) & (kSide - 1))] <= rank[at]) continue;
          const float d2 = float(dx * dx + dy * dy);
          order.share[at].push_back({dx, dy, 1 / (d2 * d2)});
          total += 1 / (d2 * d2);
        }
      for (Share& s : order.share[at]) s.weight /= total;
    }
  return order;
}

const DotOrder& dot_order() {
  static const DotOrder order = make_dot_order();
  return order;
}

}  // namespace

void diffuse_dots(std::span<const Vec3f> entries, std::span<const EntryRange* const> ranges, int width, int rows,
                  const Vec3f* normals, const std::uint16_t* region, double amount, std::uint16_t* out) {
  const DotOrder& order = dot_order();
  std::vector<Vec3f> arrived(std::size_t(width) * rows);
  for (const int texel : order.texel) {
    const std::vector<Share>& shares = order.share[texel];
    for (int y = texel / kBlueNoiseSide; y < rows; y += kBlueNoiseSide)
      for (int x = texel % kBlueNoiseSide; x < width; x += kBlueNoiseSide) {
        const std::size_t at = std::size_t(y) * width + x;
        const Vec3f n = normals[at];
        const EntryRange& range = *ranges[region[at]];
        const Vec3f wanted = n + tangential(arrived[at], n);
        const int entry = range.first + range.nearest(wanted);
        out[at] = std::uint16_t(entry);
        const Vec3f error = tangential(wanted - entries[entry], n) * float(amount);
        for (const Share& s : shares) {
          const int tx = x + s.dx, ty = y + s.dy;
          if (tx < 0 || tx >= width || ty < 0 || ty >= rows) continue;
          const std::size_t to = std::size_t(ty) * width + tx;
          if (region[to] == region[at]) arrived[to] += error * s.weight;
        }
      }
  }
}

}  // namespace burnish
