// The colour table C: every normal of a palette shaded once (Tarini et al., section 5.1).
//
//   C[i] = ambient · k_a + Σ_lights colour · reflect_m(n_i, l, v),  m the material of the interval that holds
//   i
//
// Light, view and normals are in object space, and the same for the whole table. An interval is one loop over
// one lighting model: no entry asks which model it has (section 6).
#pragma once

#include <span>
#include <vector>

#include "burnish/palette/indexed_map.h"
#include "burnish/render/light.h"
#include "burnish/render/material.h"

namespace burnish {

// `materials`: one an interval of the palette, none null. `to_viewer` and the lights' directions are unit
// vectors. Runs in parallel; each entry depends on its own normal only.
std::vector<Vec3d> shade_palette(const Palette& palette, std::span<const Material* const> materials, Vec3d ambient,
                                 std::span<const Arriving> lights, Vec3d to_viewer);

}  // namespace burnish
