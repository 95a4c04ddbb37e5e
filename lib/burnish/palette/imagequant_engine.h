// libimagequant as an engine, to compare with: at most 256 entries, which it chooses among 8-bit colours.
#pragma once

#include <vector>

#include "burnish/palette/point_tree.h"

namespace burnish {

constexpr int kImagequantMost = 256;

// Whether it was linked (BURNISH_WITH_IMAGEQUANT).
bool has_imagequant();

// At most n unit entries. Colours are opaque, since the library multiplies by alpha, and its gamma is set so that it
// works in linear values. kUnsupported where it was not linked or n is beyond 256.
std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>& points, int n);

}  // namespace burnish
