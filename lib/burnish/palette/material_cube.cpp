#include "burnish/palette/material_cube.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr std::array<std::array<int, 3>, kMostSubcubes> kBits{{{0, 0, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}}};

float square(float v) { return v * v; }

}  // namespace

MaterialCube::MaterialCube(MaterialEncoding encoding, int materials) : encoding_(encoding), materials_(materials) {
  if (encoding == MaterialEncoding::kSubcubes && materials > kMostSubcubes)
    throw Error(ErrorKind::kUnsupported,
                "material-encoding: subcubes holds at most 4 materials, not " + std::to_string(materials));
}

float MaterialCube::alpha(int material) const {
  if (materials_ == 1) return 255;
  const int least = std::min(96, 256 - materials_);
  return std::round(255 - float(255 - least) * float(material) / float(materials_ - 1));
}

Colour MaterialCube::encode(int material, Vec3f normal) const {
  const auto byte = [](float v) { return std::floor((0.5f * v + 0.5f) * 255.f + 0.5f); };
  const Colour c{byte(normal.x), byte(normal.y), byte(normal.z), 255};
  if (encoding_ == MaterialEncoding::kAlpha) return {c[0], c[1], c[2], alpha(material)};
  const auto& bits = kBits[material];
  const auto half = [&](int i) { return std::floor(c[i] / 2) + 128.f * float(bits[i]); };
  return {half(0), half(1), half(2), 255};
}

MaterialCube::Meaning MaterialCube::decode(const Colour& colour) const {
  const auto distance = [&](int material) {
    if (encoding_ == MaterialEncoding::kAlpha) return square(colour[3] - alpha(material));
    float d = 0;
    for (int i = 0; i < 3; i++) d += square(colour[i] - (63.5f + 128.f * float(kBits[material][i])));
    return d;
  };
  int material = 0;
  for (int k = 1; k < materials_; k++)
    if (distance(k) < distance(material)) material = k;
  const auto component = [&](int i) {
    const bool whole = encoding_ == MaterialEncoding::kAlpha;
    const double c = whole ? colour[i] : 2 * (colour[i] - 128.f * float(kBits[material][i])) + 0.5;
    return c / 127.5 - 1;
  };
  const Vec3d v{component(0), component(1), component(2)};
  return {material, length(v) < 1e-3 ? Vec3f{0, 0, 1} : Vec3f(normalized(v))};
}

}  // namespace burnish
