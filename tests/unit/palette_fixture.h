// Normals, palettes and maps made in memory, and the slow definitions that the fast searches are held
// against.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/mip.h"
#include "burnish/core/vec3.h"
#include "burnish/palette/fit/point_tree.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::testing {

// mt19937 is the same everywhere; the distributions of the standard library are not.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double unit() { return engine_() / 4294967296.0; }  // [0, 1)
  int below(int n) { return int(unit() * n); }
  Vec3f direction() {
    const double z = 2 * unit() - 1, a = 2 * kPi * unit(), r = std::sqrt(1 - z * z);
    return Vec3f(normalized(Vec3d{r * std::cos(a), r * std::sin(a), z}));
  }
  // Uniform within an angle of +z.
  Vec3f in_cap(double angle_deg) {
    const double z = 1 - unit() * (1 - std::cos(radians(angle_deg))), a = 2 * kPi * unit(), r = std::sqrt(1 - z * z);
    return Vec3f(normalized(Vec3d{r * std::cos(a), r * std::sin(a), z}));
  }
  std::vector<Vec3f> directions(std::size_t n) {
    std::vector<Vec3f> out(n);
    for (Vec3f& v : out) v = direction();
    return out;
  }

 private:
  std::mt19937 engine_;
};

// Spread evenly over the sphere.
inline std::vector<Vec3f> fibonacci_sphere(int n) {
  std::vector<Vec3f> out;
  for (int i = 0; i < n; i++) {
    const double z = 1 - 2 * (i + 0.5) / n, r = std::sqrt(1 - z * z), a = kPi * (3 - std::sqrt(5.0)) * i;
    out.push_back(Vec3f(normalized(Vec3d{r * std::cos(a), r * std::sin(a), z})));
  }
  return out;
}

inline double angle_deg(Vec3f a, Vec3f b) { return degrees(angle_rad(Vec3d(a), Vec3d(b))); }

// Largest dot product, the smaller index in a tie.
inline int brute_nearest(std::span<const Vec3f> entries, Vec3f v) {
  int best = 0;
  float most = dot(v, entries[0]);
  for (std::size_t i = 1; i < entries.size(); i++)
    if (const float d = dot(v, entries[i]); d > most) most = d, best = int(i);
  return best;
}

// Σ w·|p − c(p)|² over the nearest entries.
inline double brute_error(std::span<const WeightedNormal> points, std::span<const Vec3f> entries) {
  double error = 0;
  for (const WeightedNormal& p : points) {
    double least = 8;
    for (const Vec3f& c : entries) {
      const Vec3d d = Vec3d(p.normal) - Vec3d(c);
      least = std::min(least, dot(d, d));
    }
    error += p.weight * least;
  }
  return error;
}

inline std::vector<WeightedNormal> weighted(std::span<const Vec3f> normals, float weight = 1) {
  std::vector<WeightedNormal> out;
  for (const Vec3f& n : normals) out.push_back({n, weight});
  return out;
}

// Writes unit vectors as a normal map: signed in EXR, biased in other types.
inline void write_normals(const std::string& file, SampleType sample, int width, int height,
                          const std::vector<Vec3f>& normals, bool green_down = false) {
  Image image(width, height, 3);
  const bool biased = sample == SampleType::kUint8 || sample == SampleType::kUint16;
  for (std::size_t i = 0; i < normals.size(); i++)
    for (int c = 0; c < 3; c++) {
      float v = c == 0 ? normals[i].x : c == 1 ? (green_down ? -normals[i].y : normals[i].y) : normals[i].z;
      image.data[3 * i + c] = biased ? 0.5f * v + 0.5f : v;
    }
  write_image(file, file_type_of(file), sample, image);
}

inline void write_ids(const std::string& file, int width, int height, const std::vector<int>& ids) {
  Image image(width, height, 1);
  for (std::size_t i = 0; i < ids.size(); i++) image.data[i] = float(ids[i]) / 255.f;
  write_image(file, file_type_of(file), SampleType::kUint8, image);
}

// Bumps that cover a good part of the hemisphere, with some grain.
inline std::vector<Vec3f> bumpy_normals(int width, int height, std::uint32_t seed = 1) {
  Random random(seed);
  std::vector<Vec3f> out;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      const double a = std::sin(0.21 * x + 0.4 * std::sin(0.13 * y)) + 0.1 * (random.unit() - 0.5),
                   b = std::cos(0.17 * y + 0.05 * x) + 0.1 * (random.unit() - 0.5);
      out.push_back(Vec3f(normalized(Vec3d{a, b, 1})));
    }
  return out;
}

// A palette of `materials` equal shares, ids 0, 3, 6, …, and a base of random indices.
inline IndexedMap random_map(int width, int height, int entries, int materials, std::uint32_t seed = 7) {
  Random random(seed);
  IndexedMap map;
  map.palette.normals = random.directions(entries);
  for (int m = 0; m < materials; m++) {
    const int first = m * entries / materials, end = (m + 1) * entries / materials;
    map.palette.materials.push_back({3 * m, first, end - first});
  }
  map.levels.emplace_back(width, height);
  for (std::uint16_t& index : map.levels[0].data) index = std::uint16_t(random.below(entries));
  return map;
}

}  // namespace burnish::testing
