// Fits colours to a weighted set of them by k-means in the RGB(A) cube: the spherical engine's steps, off the sphere.
//
// Minimises Σ w·|p − c(p)|² over the colours p and their nearest entries c. Boxes are cut in two where that saves most,
// across the axis of largest variance, until there are n; Lloyd iterations follow. All four components count alike, so
// that materials farther apart in alpha than the cells are wide do not share one. Deterministic, whatever the threads.
#pragma once

#include <vector>

#include "burnish/palette/fit/weighted_colour.h"

namespace burnish {

// At most n colours, fewer where there are fewer points. The points' components are whole, 0 … 255.
std::vector<Colour> fit_colour_codebook(const std::vector<WeightedColour>& points, int n);

}  // namespace burnish
