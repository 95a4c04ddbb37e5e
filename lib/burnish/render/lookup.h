// Texture coordinates to texels: u to the right, v up; texel (column x, row y) of W×H has its centre at
// u = (x + ½)/W, v = 1 − (y + ½)/H.
#pragma once

#include <algorithm>
#include <cmath>

namespace burnish {

enum class Filter { kNearest, kBilinear };

// The map repeats in u; in v it repeats, or ends where its first and last rows are poles.
struct Addressing {
  bool repeat_v = true;
};

struct TexelPosition {
  int x, y;
};

struct BilinearTaps {
  TexelPosition texel[4];
  double weight[4];  // sum to 1
};

inline int wrapped(double i, int n, bool repeat) {
  if (!repeat) return int(std::clamp(i, 0.0, double(n - 1)));
  const double r = i - n * std::floor(i / n);
  return std::min(int(r), n - 1);
}

// The texel whose square holds the point; its left and top sides belong to it.
inline TexelPosition nearest_texel(double u, double v, int width, int height, Addressing addressing) {
  return {wrapped(std::floor(u * width), width, true),
          wrapped(std::floor((1 - v) * height), height, addressing.repeat_v)};
}

inline BilinearTaps bilinear_taps(double u, double v, int width, int height, Addressing addressing) {
  const double x = u * width - 0.5, y = (1 - v) * height - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  const int left = wrapped(x0, width, true), right = wrapped(x0 + 1, width, true);
  const int top = wrapped(y0, height, addressing.repeat_v), bottom = wrapped(y0 + 1, height, addressing.repeat_v);
  return {{{left, top}, {right, top}, {left, bottom}, {right, bottom}},
          {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

}  // namespace burnish
