// libimagequant as an engine, to compare with: at most 256 entries, which it chooses among 8-bit colours.
//
// Its gamma is set so that it works in linear values. It multiplies colours by alpha.
#pragma once

#include <vector>

#include "burnish/palette/fit/weighted_colour.h"
#include "burnish/palette/fit/weighted_normal.h"

namespace burnish {

constexpr int kImagequantMost = 256;

// Whether it was linked (BURNISH_WITH_IMAGEQUANT).
bool has_imagequant();

// At most n unit entries, of opaque colours. kUnsupported where it was not linked or n is beyond 256.
std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>& points, int n);

// At most n colours of colours of whole components. kUnsupported as above.
std::vector<Colour> fit_imagequant(const std::vector<WeightedColour>& points, int n);

}  // namespace burnish
