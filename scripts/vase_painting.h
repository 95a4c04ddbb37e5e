// What is painted on the vase and what is cut into it, as functions of the turn u and the height y on the outside.
//
// Each motif gets x, once from 0 to 1 in each of its repetitions, and y from 0 to 1 across its band.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/core/vec3.h"
#include "burnish/mesh/mesh.h"

namespace burnish {

inline double fraction(double x) { return x - std::floor(x); }

inline bool meander(double x, double y) {
  static constexpr std::array<const char*, 7> kKey{"#######.", "#.....#.", "#.###.#.", "#.#...#.",
                                                   "#.#####.", "#.......", "########"};
  return kKey[std::clamp(int((1 - y) * 7), 0, 6)][std::min(7, int(x * 8))] == '#';
}

inline bool rays(double x, double y) { return std::abs(x - 0.5) < 0.42 * (1 - y); }

inline bool tongues(double x, double y) {
  const double across = std::abs(x - 0.5) / 0.36, round = std::max(0.0, 0.35 - y) / 0.35;
  return across * across + round * round < 1 && !(across < 0.45 && y > 0.3 && y < 0.9);
}

inline bool waves(double x, double y) { return y < 0.25 + 0.6 * std::pow(std::abs(std::sin(kPi * x)), 3); }

struct Dot {
  Vec2d centre;
  double radius;
  bool holds(Vec2d p) const { return std::hypot(p.x - centre.x, p.y - centre.y) < radius; }
};

// Leaping to the right, in a square from −1 to 1: a bent body, two flukes, fins, an eye left out.
inline bool dolphin(Vec2d p) {
  const auto spine = [](double s) {
    const double a = (158 - 128 * s) * kPi / 180;
    return Vec2d{0.86 * std::cos(a) - 0.02, 1.02 * std::sin(a) - 0.62};
  };
  const auto fin = [&](Vec2d root, Vec2d tip, double width) {  // tapers from the root
    const Vec2d along = tip - root, from = p - root;
    const double size2 = along.x * along.x + along.y * along.y, t = (along.x * from.x + along.y * from.y) / size2;
    return t >= 0 && t <= 1 && std::abs(cross(along, from)) / std::sqrt(size2) < width * (1 - t);
  };
  if (Dot{spine(0.86) + Vec2d{0.03, 0.05}, 0.035}.holds(p)) return false;
  for (int k = 0; k <= 40; k++) {
    const double s = k / 40.0;
    if (Dot{spine(s), 0.03 + 0.19 * std::pow(std::sin(kPi * std::pow(s, 1.25)), 0.8)}.holds(p)) return true;
  }
  const Vec2d tail = spine(0), nose = spine(1);
  return fin(tail, tail + Vec2d{-0.28, 0.12}, 0.09) || fin(tail, tail + Vec2d{0.06, -0.30}, 0.09) ||
         fin(nose + Vec2d{-0.08, 0.12}, nose + Vec2d{0.14, -0.14}, 0.08) ||
         fin(spine(0.50), spine(0.30) + Vec2d{-0.02, 0.36}, 0.13) || fin(spine(0.66), Vec2d{0.16, -0.22}, 0.10);
}

inline constexpr int kDolphins = 6;
// In the frieze: of one of its squares, whose middle is a dolphin's.
inline Vec2d in_frieze(double u, double y, double shift) {
  return {2 * fraction(u * kDolphins + shift) - 1, (y - 0.085) / 0.27};
}

inline bool painted(double u, double y) {
  struct Band {
    double low, high;
    int repeats;
    bool (*motif)(double, double);
  };
  static constexpr auto solid = [](double, double) { return true; };
  static constexpr std::array<Band, 14> kBands{{{-2.00, -0.945, 1, solid},
                                                {-0.925, -0.80, 1, solid},
                                                {-0.78, -0.50, 22, rays},
                                                {-0.475, -0.45, 1, solid},
                                                {-0.43, -0.29, 26, meander},
                                                {-0.27, -0.245, 1, solid},
                                                {-0.245, -0.17, 36, waves},
                                                {0.335, 0.36, 1, solid},
                                                {0.38, 0.49, 24, meander},
                                                {0.51, 0.60, 26, tongues},
                                                {0.615, 0.635, 1, solid},
                                                {0.83, 0.85, 1, solid},
                                                {0.87, 2.00, 1, solid},
                                                {0.66, 0.68, 1, solid}}};
  for (const Band& band : kBands)
    if (y >= band.low && y < band.high)
      return band.motif(fraction(u * band.repeats), (y - band.low) / (band.high - band.low));
  return y > -0.17 && y < 0.335 && dolphin(in_frieze(u, y, 0.5));
}

// Flowers between the dolphins, and a zigzag round the neck.
inline bool engraved(double u, double y) {
  if (y > 0.70 && y < 0.81) return std::abs(std::abs(2 * fraction(u * 12) - 1) - (y - 0.70) / 0.11) < 0.17;
  if (y < -0.17 || y > 0.335) return false;
  const Vec2d p = (in_frieze(u, y, 0) - Vec2d{0, 0.42}) * 1.6;
  const double r = std::hypot(p.x * 1.15, p.y), petal = std::cos(4 * std::atan2(p.y, p.x * 1.15));
  return r < 0.12 || (r > 0.18 && r < 0.30 + 0.26 * petal * petal * (petal > 0 ? 1 : 0.5));
}

}  // namespace burnish
