// Places flat charts beside each other in the unit square, as large as they fit.
//
// Each chart, the largest first, goes where it rises least in one of eight turns, then furthest left; any free place
// will do, within the bays of others too. The scale, one for all, is searched for.
#pragma once

#include <vector>

#include "burnish/core/progress.h"
#include "burnish/mesh/atlas/flat_chart.h"

namespace burnish {

// Moves each chart's points to texture coordinates. At `size` × `size` texels no texel is touched by two charts, and
// between those of different charts, and along the square's border, lie at least kGutter that none touches. False where
// there are more charts than so few texels have room for.
constexpr int kGutter = 2;
bool pack(std::vector<FlatChart>& charts, int size, const Progress& progress = {});

}  // namespace burnish
