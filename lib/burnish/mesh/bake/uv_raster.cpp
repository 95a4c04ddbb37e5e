#include "burnish/mesh/bake/uv_raster.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <string>

#include "burnish/core/error.h"
#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr std::int64_t kTexel = 4096, kHalf = kTexel / 2;
// Triangles are listed by bands of rows: where many lie on the same texels, lists of each row would not fit in memory.
constexpr int kBand = 32;

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b != 0 && (a < 0) != (b < 0)); }
std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return -floor_div(-a, b); }

}  // namespace

template <typename Body>
void UvRaster::for_each_band(Rows rows, const Body& body) {
  for (int band = rows.first / kBand; band * kBand < rows.end; band++) body(band);
}

std::int64_t UvRaster::twice_area(Place a, Place b, Place c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// A centre on an edge counts as if it lay a little to the right, and much less below.
UvRaster::Edge UvRaster::edge(Place a, Place b, int y) {
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  return {twice_area(a, b, {kHalf, y * kTexel + kHalf}), dy * kTexel, dy < 0 || (dy == 0 && dx > 0)};
}

UvRaster::UvRaster(const Mesh& mesh, int width, int height) : width_(width) {
  if (width < 1 || height < 1 || width > kMostTexels || height > kMostTexels)
    throw Error(ErrorKind::kUsage, "size: expected 1 to " + std::to_string(kMostTexels) + " texels a side, got " +
                                       std::to_string(width) + "x" + std::to_string(height));
  const std::size_t count = mesh.triangle_uvs.size();
  places_.resize(count);
  rows_.resize(count);
  band_begin_.assign(std::size_t(height / kBand) + 2, 0);
  for (std::size_t t = 0; t < count; t++) {
    std::array<Place, 3>& p = places_[t];
    for (int c = 0; c < 3; c++) {
      const Vec2d uv = mesh.uv(t, c);
      p[c] = {std::llround(uv.x * width * kTexel), std::llround((1 - uv.y) * height * kTexel)};
    }
    if (twice_area(p[0], p[1], p[2]) == 0) continue;
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    rows_[t] = {int(ceil_div(top - kHalf, kTexel)),
                int(std::min<std::int64_t>(floor_div(bottom - kHalf, kTexel) + 1, height))};
    for_each_band(rows_[t], [&](int band) { band_begin_[band + 1]++; });
  }
  std::partial_sum(band_begin_.begin(), band_begin_.end(), band_begin_.begin());
  band_triangles_.resize(band_begin_.back());
  std::vector<std::size_t> next(band_begin_.begin(), band_begin_.end() - 1);
  for (std::size_t t = 0; t < count; t++)
    for_each_band(rows_[t], [&](int band) { band_triangles_[next[band]++] = std::uint32_t(t); });
}

void UvRaster::row(int y, std::uint32_t* triangles, std::uint8_t* several) const {
  std::fill_n(triangles, width_, kNone);
  std::fill_n(several, width_, std::uint8_t(0));
  // At or behind each texel the next one that has no two triangles yet.
  std::vector<int> open(std::size_t(width_) + 1);
  std::iota(open.begin(), open.end(), 0);
  const auto next_open = [&](int x) {
    while (open[x] != x) x = open[x] = open[open[x]];
    return x;
  };
  for (std::size_t i = band_begin_[y / kBand]; i < band_begin_[y / kBand + 1] && next_open(0) < width_; i++) {
    const std::uint32_t t = band_triangles_[i];
    if (y < rows_[t].first || y >= rows_[t].end) continue;
    const std::array<Place, 3>& p = places_[t];
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    if (next_open(int(left / kTexel)) * kTexel > right) continue;
    const bool turned = twice_area(p[0], p[1], p[2]) < 0;
    std::int64_t first = 0, end = width_;
    for (int c = 0; c < 3 && first < end; c++) {
      const Place a = p[c], b = p[(c + 1) % 3];
      const Edge e = turned ? edge(b, a, y) : edge(a, b, y);
      const std::int64_t least = e.takes_ties ? 0 : 1;  // value − x·step must not be below
      if (e.step > 0) end = std::min(end, floor_div(e.value - least, e.step) + 1);
      else if (e.step < 0) first = std::max(first, ceil_div(least - e.value, -e.step));
      else if (e.value < least) end = first;
    }
    if (first >= end) continue;
    for (int x = next_open(int(first)); x < end; x = next_open(x + 1)) {
      if (triangles[x] == kNone) triangles[x] = t;
      else several[x] = 1, open[x] = x + 1;
    }
  }
}

MeshPoint UvRaster::point(std::uint32_t triangle, int x, int y) const {
  const std::array<Place, 3>& p = places_[triangle];
  const Place centre{x * kTexel + kHalf, y * kTexel + kHalf};
  const double area = double(twice_area(p[0], p[1], p[2]));
  MeshPoint point{triangle, {}};
  for (int c = 0; c < 3; c++) point.weight[c] = double(twice_area(p[(c + 1) % 3], p[(c + 2) % 3], centre)) / area;
  return point;
}

std::vector<std::uint32_t> uv_charts(const Mesh& mesh) {
  const std::vector<std::uint32_t> positions = weld(mesh.positions), uvs = weld(mesh.uvs);
  // An edge is the same where both its ends are, in space and in the map; sorting brings equal ones together.
  struct Edge {
    std::uint64_t a, b;  // a position above, a texture coordinate below
    std::uint32_t triangle;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangle_uvs.size());
  for (std::uint32_t t = 0; t < mesh.triangle_uvs.size(); t++) {
    const auto end = [&](int c) {
      return std::uint64_t(positions[mesh.triangles[t][c]]) << 32 | uvs[mesh.triangle_uvs[t][c]];
    };
    for (int c = 0; c < 3; c++) {
      const auto [a, b] = std::minmax({end(c), end((c + 1) % 3)});
      edges.push_back({a, b, t});
    }
  }
  std::ranges::sort(edges);

  std::vector<std::uint32_t> leader(mesh.triangle_uvs.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  for (std::size_t i = 1; i < edges.size(); i++)
    if (edges[i].a == edges[i - 1].a && edges[i].b == edges[i - 1].b) {
      const std::uint32_t a = find(edges[i - 1].triangle), b = find(edges[i].triangle);
      leader[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::uint32_t> chart(leader.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < leader.size(); t++) chart[t] = find(t) == t ? count++ : chart[find(t)];
  return chart;
}

}  // namespace burnish
