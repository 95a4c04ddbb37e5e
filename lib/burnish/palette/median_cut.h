// The median-cut engine, as the paper's own pipeline used it (ppmquant of netpbm): boxes in the RGB cube.
//
// Heckbert's algorithm with ppmquant's choices: the box with the most texels is cut at their median along its longest
// side, and its colour is the mean of its texels. The colours are the vectors of 8-bit normals, so the boxes know
// nothing of the sphere; the entries are renormalised. Here to compare with.
#pragma once

#include <vector>

#include "burnish/palette/point_tree.h"

namespace burnish {

// At most n unit entries; fewer where there are fewer points.
std::vector<Vec3f> fit_median_cut(const std::vector<WeightedNormal>& points, int n);

}  // namespace burnish
