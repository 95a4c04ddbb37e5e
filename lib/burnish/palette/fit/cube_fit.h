// Palettes fitted in the cube of colours that material and normal share: the paper's way with materials.
//
// The groups of a histogram become 8-bit colours, an engine quantizes them all together, and what its colours mean are
// the entries, each of one material; how many a material gets is up to the engine. A material that gets none is given
// its mean normal. spherical is k-means in the cube (colour_codebook.h), median-cut and imagequant are what their names
// say; means are kept as they come, unrounded.
#pragma once

#include <vector>

#include "burnish/palette/engine.h"
#include "burnish/palette/fit/point_tree.h"
#include "burnish/palette/material_cube.h"

namespace burnish {

// Unit entries of each group, at most n in all and at least one each. Where there are no more distinct normals than n,
// they are the entries. n is at least the number of groups.
std::vector<std::vector<Vec3f>> fit_in_cube(const std::vector<std::vector<WeightedNormal>>& groups,
                                            const MaterialCube& cube, Engine engine, int n);

// What colours mean: unit entries of each material.
std::vector<std::vector<Vec3f>> meanings(const std::vector<Colour>& colours, const MaterialCube& cube,
                                         std::size_t materials);

}  // namespace burnish
