#include "burnish/render/picture.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

// Five stops after matplotlib's "inferno" (Smith & van der Walt, CC0), joined by straight lines in sRGB, as
// CSS joins them.
struct HeatStop {
  const char* css;
  Vec3d colour;
};
constexpr HeatStop kHeat[]{{"#000004", {0x00 / 255., 0x00 / 255., 0x04 / 255.}},
                           {"#57106e", {0x57 / 255., 0x10 / 255., 0x6e / 255.}},
                           {"#bc3754", {0xbc / 255., 0x37 / 255., 0x54 / 255.}},
                           {"#f98e09", {0xf9 / 255., 0x8e / 255., 0x09 / 255.}},
                           {"#fcffa4", {0xfc / 255., 0xff / 255., 0xa4 / 255.}}};
constexpr float kOffObject = 0.35f;

}  // namespace

double srgb_from_linear(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * portable::pow(c, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double srgb) {
  const double c = std::clamp(srgb, 0.0, 1.0);
  return c <= 0.04045 ? c / 12.92 : portable::pow((c + 0.055) / 1.055, 2.4);
}

Image srgb_picture(const Image& linear, double exposure_stops) {
  const double gain = portable::exp2(exposure_stops);
  Image out(linear.width, linear.height, linear.channels);
  parallel_for(linear.height, [&](std::size_t y) {
    std::transform(linear.row(int(y)), linear.row(int(y)) + std::size_t(linear.width) * linear.channels,
                   out.row(int(y)), [&](float c) { return float(srgb_from_linear(gain * c)); });
  });
  return out;
}

Vec3d heat_colour(double x) {
  constexpr int kSteps = int(std::size(kHeat)) - 1;
  const double at = std::clamp(x, 0.0, 1.0) * kSteps;
  const int i = std::min(int(at), kSteps - 1);
  return kHeat[i].colour * (1 - (at - i)) + kHeat[i + 1].colour * (at - i);
}

std::string heat_css_gradient() {
  std::string out = "linear-gradient(to right";
  for (const HeatStop& stop : kHeat) out += std::string(", ") + stop.css;
  return out + ")";
}

Image heat_picture(const Image& a, const Image& b, const ByteImage& counts, double full) {
  Image out(a.width, a.height, 3);
  parallel_for(a.height, [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < a.width; x++) {
      float* to = out.at(x, y);
      if (!*counts.at(x, y)) {
        std::fill_n(to, 3, kOffObject);
        continue;
      }
      double worst = 0;
      for (int c = 0; c < a.channels; c++)
        worst = std::max(worst, std::abs(double(a.at(x, y)[c]) - double(b.at(x, y)[c])));
      const Vec3d heat = heat_colour(worst / full);
      to[0] = float(heat.x), to[1] = float(heat.y), to[2] = float(heat.z);
    }
  });
  return out;
}

}  // namespace burnish
