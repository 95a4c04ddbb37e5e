// Makes the inputs of the samples: a displacement map of paving stones, and the object-space normal map of a cratered
// planet.
//
//   make-samples DIRECTORY [SIDE]      SIDE texels of the stones, 1024 by default
//
// Everything comes from an integer hash, so that the maps are the same everywhere.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "burnish/core/vec3.h"
#include "noise.h"

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

struct Crater {
  Vec3d centre;
  double radius, depth;
};

std::vector<Crater> craters() {
  std::vector<Crater> out;
  for (int i = 0; i < 180; i++) {
    const double z = 2 * hash(i, 0, 0, 7) - 1, a = 2 * kPi * hash(i, 1, 0, 7), r = std::sqrt(1 - z * z);
    const double radius = 0.035 + 0.26 * std::pow(hash(i, 2, 0, 7), 5);
    out.push_back({{r * std::cos(a), r * std::sin(a), z}, radius, 0.22 * radius});
  }
  return out;
}

// Distance of the planet's surface from its centre.
double planet(Vec3d d, const std::vector<Crater>& all) {
  double h = 0.06 * turbulence(d * 2.5, 7, 30);
  for (const Crater& c : all) {
    const double t = length(d - c.centre) / c.radius;
    if (t >= 1.6) continue;
    const double bowl = t < 1 ? (t * t - 1) : 0,
                 rim = 0.45 * std::exp(-std::pow((t - 1) / 0.22, 2)) * (1 - ramp(1.3, 1.6, t));
    h += c.depth * (bowl + rim);
  }
  return 1 + h;
}

Image make_stones(int n) {
  Image image(n, n, 1);
  parallel_for(n, [&](std::size_t y) {
    for (int x = 0; x < n; x++) image.row(int(y))[x] = float(stones((x + 0.5) / n, 1 - (double(y) + 0.5) / n));
  });
  return image;
}

// Latitude and longitude as the renderer lays a map on its sphere: v up, u = ½ facing +z and growing towards +x.
Image make_planet_normals(int w, int h) {
  const std::vector<Crater> all = craters();
  Image image(w, h, 3);
  const auto direction = [](double u, double v) {
    const double longitude = 2 * kPi * (u - 0.5), latitude = kPi * (v - 0.5);
    return Vec3d{std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                 std::cos(latitude) * std::cos(longitude)};
  };
  parallel_for(h, [&](std::size_t y) {
    for (int x = 0; x < w; x++) {
      const Vec3d d = direction((x + 0.5) / w, 1 - (double(y) + 0.5) / h);
      // Slopes along two tangents, so that the poles are like any other place.
      const Vec3d t = normalized(std::abs(d.y) < 0.9 ? cross(Vec3d{0, 1, 0}, d) : cross(Vec3d{1, 0, 0}, d)),
                  b = cross(d, t);
      const double step = kPi / h;
      const auto point = [&](Vec3d q) { return normalized(q) * planet(normalized(q), all); };
      const Vec3d n =
          normalized(cross(point(d + t * step) - point(d - t * step), point(d + b * step) - point(d - b * step)));
      float* out = image.at(x, int(y));
      out[0] = float(0.5 * n.x + 0.5), out[1] = float(0.5 * n.y + 0.5), out[2] = float(0.5 * n.z + 0.5);
    }
  });
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  const int side = argc > 2 ? std::atoi(argv[2]) : 1024;
  if (argc < 2 || argc > 3 || side < 1 || side > 32768) {
    std::fprintf(stderr, "usage: make-samples DIRECTORY [SIDE]\n");
    return 1;
  }
  try {
    const std::string directory = argv[1];
    write_image(directory + "/stones.png", FileType::kPng, SampleType::kUint16, make_stones(side));
    write_image(directory + "/planet_n.png", FileType::kPng, SampleType::kUint16, make_planet_normals(1024, 512));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make-samples: error: %s\n", error.what());
    return 2;
  }
}
