#include "burnish/normal/plane_fit.h"

#include <string>

#include "burnish/core/error.h"
#include "burnish/core/portable_math.h"

namespace burnish {

Neighborhood make_neighborhood(int q, FitWeights weights) {
  const bool cross = q == 4;
  int r = 1;
  while (!cross && r <= 4 && (2 * r + 1) * (2 * r + 1) - 1 != q) r++;
  if (r > 4) throw Error(ErrorKind::kUsage, "neighbors: expected 4, 8, 24, 48 or 80, got " + std::to_string(q));

  const double sigma = 0.5 * r;
  // Along one axis; the weight of a tap is the product of both. Rounded, so that no machine's exp shows in the result.
  const auto g = [&](int i) {
    return weights == FitWeights::kUniform ? 1.0 : double(float(portable::exp(-i * i / (2 * sigma * sigma))));
  };
  Neighborhood n;
  n.radius = r;
  for (int y = -r; y <= r; y++)
    for (int x = -r; x <= r; x++)
      if (!cross || x == 0 || y == 0) n.taps.push_back({x, y, float(g(x) * g(y))});

  double second_moment = 0, sum = 0;
  for (int i = -r; i <= r; i++) second_moment += g(i) * i * i, sum += g(i);
  for (int i = 0; i <= r; i++) n.derivative.push_back(float(g(i) * i / second_moment));
  if (cross) n.smoothing = {1.f};
  else
    for (int i = 0; i <= r; i++) n.smoothing.push_back(float(g(i) / sum));
  return n;
}

PlaneSlope fit_plane(const Neighborhood& neighborhood, const float* d, const bool* exists) {
  const std::vector<Neighborhood::Tap>& taps = neighborhood.taps;
  double w = 0, mx = 0, my = 0, md = 0;
  for (std::size_t i = 0; i < taps.size(); i++) {
    if (!exists[i]) continue;
    const double wi = taps[i].weight;
    w += wi, mx += wi * taps[i].x, my += wi * taps[i].y, md += wi * d[i];
  }
  if (w <= 0) return {};
  mx /= w, my /= w, md /= w;
  double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (std::size_t i = 0; i < taps.size(); i++) {
    if (!exists[i]) continue;
    const double x = taps[i].x - mx, y = taps[i].y - my, wi = taps[i].weight;
    xx += wi * x * x, xy += wi * x * y, yy += wi * y * y;
    xd += wi * x * (d[i] - md), yd += wi * y * (d[i] - md);
  }
  // On a line the determinant is 0 but for rounding; the least three points off a line leave more than 1e-4 of this
  // square.
  const double det = xx * yy - xy * xy;
  if (det < 1e-9 * (xx + yy) * (xx + yy) || xx + yy == 0) return {};
  return {(xd * yy - yd * xy) / det, (yd * xx - xd * xy) / det, true};
}

}  // namespace burnish
