// Makes inputs of the samples: a displacement map of paving stones, and a panorama of light from all sides.
//
//   make-samples DIRECTORY [SIDE]      SIDE texels of the stones, 1024 by default
//
// Everything comes from an integer hash, so that the maps are the same everywhere.
#include <cmath>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "burnish/core/vec3.h"
#include "noise.h"
#include "program.h"

using namespace burnish;

namespace {

double ramp(double low, double high, double x) {
  const double t = std::min(1.0, std::max(0.0, (x - low) / (high - low)));
  return t * t * (3 - 2 * t);
}

// Stones with rounded edges and gaps of sand between them; the map tiles.
double stones(double u, double v) {
  constexpr int kCells = 9;
  u += 0.012 * turbulence({u * 12, v * 12, 0.5}, 3, 40, 12);
  v += 0.012 * turbulence({u * 12, v * 12, 7.5}, 3, 50, 12);
  const double x = u * kCells, y = v * kCells;
  const int cx = int(std::floor(x)), cy = int(std::floor(y));
  const auto wrap = [](int i) { return ((i % kCells) + kCells) % kCells; };
  double first = 9, second = 9;
  int id = 0;
  Vec3d from;
  for (int j = -2; j <= 2; j++)
    for (int i = -2; i <= 2; i++) {
      const int sx = wrap(cx + i), sy = wrap(cy + j);
      const double dx = cx + i + 0.15 + 0.7 * hash(sx, sy, 1, 1) - x, dy = cy + j + 0.15 + 0.7 * hash(sx, sy, 2, 1) - y;
      const double d = std::sqrt(dx * dx + dy * dy);
      if (d < first) second = first, first = d, id = sx + kCells * sy, from = {dx, dy, 0};
      else if (d < second) second = d;
    }
  const double edge = ramp(0.03, 0.35, second - first);
  const double tilt = 0.25 * ((hash(id, 3, 0, 2) - 0.5) * from.x + (hash(id, 4, 0, 2) - 0.5) * from.y);
  const double grain = turbulence({u * 24, v * 24, id + 0.5}, 5, 10, 24);
  const double sand = turbulence({u * 64, v * 64, 0.5}, 3, 20, 64);
  const double stone = 0.55 + 0.2 * hash(id, 5, 0, 2) + tilt + 0.09 * grain - 0.15 * first * first;
  return std::min(1.0, std::max(0.0, edge * stone + (1 - edge) * (0.18 + 0.06 * sand)));
}

// Light that comes from a direction: sky with a sun and clouds above, tiles and distant hills below, and three soft
// boxes as photographers hang them.
Vec3d surroundings(Vec3d d) {
  const auto mix = [](Vec3d a, Vec3d b, double t) { return a * (1 - t) + b * t; };
  const double hills = 0.05 + 0.09 * turbulence({3 * d.x, 3 * d.z, 0.5}, 4, 200);
  Vec3d light;
  if (d.y > hills) {
    light = mix({0.80, 0.88, 0.95}, {0.12, 0.28, 0.75}, std::sqrt(d.y));
    const double cloud = ramp(0.02, 0.35, turbulence({2 * d.x / (d.y + 0.3), 2 * d.z / (d.y + 0.3), 4.5}, 5, 210));
    light = mix(light, {1.1, 1.08, 1.05}, 0.8 * cloud);
  } else if (d.y > 0) {
    light = mix({0.16, 0.20, 0.12}, {0.30, 0.38, 0.42}, d.y / 0.1);
  } else {
    const double x = d.x / (0.05 - d.y), z = d.z / (0.05 - d.y);
    const double tiles = ramp(-0.25, 0.25, std::sin(2.2 * x) * std::sin(2.2 * z));
    const Vec3d floor = mix({0.24, 0.13, 0.07}, {0.46, 0.35, 0.24}, tiles);
    light = mix({0.30, 0.27, 0.22}, floor, ramp(0.05, 0.40, -d.y));
  }
  const Vec3d sun = normalized(Vec3d{-0.8, 0.75, 0.9});
  const double towards_sun = dot(d, sun);
  light += Vec3d{6, 5.4, 4.4} * ramp(0.990, 0.998, towards_sun) +
           Vec3d{0.9, 0.75, 0.5} * std::pow(std::max(0.0, towards_sun), 60);
  struct Box {
    Vec3d towards;
    double half_width, half_height, brightness;
  };
  for (const Box& box : {Box{{1.0, 0.45, 0.5}, 0.16, 0.42, 2.5},
                         {{-1.0, 0.35, -0.25}, 0.12, 0.40, 1.8},
                         {{0.1, 0.8, -1.0}, 0.5, 0.10, 1.8}}) {
    const Vec3d middle = normalized(box.towards), right = normalized(cross({0, 1, 0}, middle)),
                up = cross(middle, right);
    const double along = dot(d, middle);
    if (along <= 0) continue;
    const double x = std::abs(dot(d, right) / along) / box.half_width,
                 y = std::abs(dot(d, up) / along) / box.half_height;
    const double inside = (1 - ramp(0.94, 1.0, x)) * (1 - ramp(0.97, 1.0, y));
    light = mix(light, Vec3d{1, 0.98, 0.95} * box.brightness, inside);
  }
  return light;
}

Image make_stones(int n) {
  Image image(n, n, 1);
  parallel_for(n, [&](std::size_t y) {
    for (int x = 0; x < n; x++) image.row(int(y))[x] = float(stones((x + 0.5) / n, 1 - (double(y) + 0.5) / n));
  });
  return image;
}

// Latitude by longitude, as the renderer takes an environment: the middle lies towards −z, the right half towards +x.
Image make_panorama(int w, int h) {
  Image image(w, h, 3);
  parallel_for(h, [&](std::size_t y) {
    for (int x = 0; x < w; x++) {
      constexpr int kSamples = 3;  // a side
      Vec3d sum;
      for (int k = 0; k < kSamples * kSamples; k++) {
        const double u = (x + (k % kSamples + 0.5) / kSamples) / w,
                     v = 1 - (double(y) + (k / kSamples + 0.5) / kSamples) / h;
        const double longitude = 2 * kPi * (u - 0.5), latitude = kPi * (v - 0.5);
        sum += surroundings(
            {std::cos(latitude) * std::sin(longitude), std::sin(latitude), -std::cos(latitude) * std::cos(longitude)});
      }
      const Vec3f mean(sum / double(kSamples * kSamples));
      float* out = image.at(x, int(y));
      out[0] = mean.x, out[1] = mean.y, out[2] = mean.z;
    }
  });
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-samples DIRECTORY [SIDE]", argc, argv, [](const Arguments& a) {
    const int side = integer_argument(a, 1, 1024, 1, 32768);
    write_image(a[0] + "/stones.png", FileType::kPng, SampleType::kUint16, make_stones(side));
    write_image(a[0] + "/panorama.exr", FileType::kExr, SampleType::kHalf, make_panorama(1024, 512));
  });
}
