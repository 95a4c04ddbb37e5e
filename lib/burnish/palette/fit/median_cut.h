// The median-cut engine, as the paper's own pipeline used it (ppmquant of netpbm): boxes in the RGB(A) cube.
//
// Heckbert's algorithm with ppmquant's choices: the box with the most texels is cut at their median along its longest
// side, and its colour is the mean of its texels. Here to compare with.
#pragma once

#include <vector>

#include "burnish/palette/fit/weighted_colour.h"
#include "burnish/palette/fit/weighted_normal.h"

namespace burnish {

// At most n unit entries; fewer where there are fewer points. The cube is that of the vectors themselves, so the boxes
// know nothing of the sphere; the means are made unit.
std::vector<Vec3f> fit_median_cut(const std::vector<WeightedNormal>& points, int n);

// At most n colours, in all four components.
std::vector<Colour> fit_median_cut(const std::vector<WeightedColour>& points, int n);

}  // namespace burnish
