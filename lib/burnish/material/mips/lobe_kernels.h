// Reflectance of a lobe at many pairs of light and view, for whatever vector unit the machine has.
#pragma once

#include <span>

#include "burnish/material/mips/direction_pairs.h"
#include "burnish/material/mips/lobe.h"

namespace burnish::kernels {

// out[i] = L_o of pair i
void reflectance(MaterialModel model, const Lobe& lobe, std::span<const PairBlock> pairs, float* out);

// Of a lobe with k_s = 1: how it turns (radians about t, b and n) and widens (ln α_x, ln α_y).
inline constexpr int kShape = 5;

// Sums over pairs, with g the lobe's L_o for k_s = 1 and d its derivatives by the shape, both times a scale of each
// pair, and w the wanted L_o times the same.
struct LobeSums {
  double gg, gw;
  double gd[kShape], wd[kShape], dd[kShape][kShape];  // dd: of its lower triangle
};
LobeSums lobe_sums(MaterialModel model, const Lobe& lobe, std::span<const PairBlock> pairs, const float* scale,
                   const float* scaled_wanted);

}  // namespace burnish::kernels
