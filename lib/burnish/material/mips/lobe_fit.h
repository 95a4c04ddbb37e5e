// The lobe whose reflectance is nearest to a wanted one, in the least squares over a set of lights and views:
//
//   minimise  Σ_i (w_i − k_s g_i(lobe))² / √(w_i/P + 1/20) + ε P² ‖x‖²
//
// over mean normal, α_x, α_y, direction of t and k_s. P is the peak of the lobe that the fit starts from. The root lets
// the flanks, where most lights and views are, count beside the peak. For each lobe the best k_s is a quotient
// (variable projection); the rest is a damped Gauss-Newton descent (Levenberg & Marquardt) on the turn of the frame, ln
// α_x and ln α_y.
//
// x is how far the lobe is from the start: tilts in widths of the lobe, the turn about n in half radians, ln α in
// halves, k_s in itself. With ε = 0.1 that counts as little as a tenth of one pair that sees the peak: it decides only
// where the pairs miss a lobe, or where nothing else does, such as the direction of a round one. Sources: Golub &
// Pereyra, "The differentiation of pseudo-inverses and nonlinear least squares problems" (1973); Marquardt, "An
// algorithm for least-squares estimation of nonlinear parameters" (1963).
#pragma once

#include <span>

#include "burnish/material/mips/direction_pairs.h"
#include "burnish/material/mips/lobe.h"

namespace burnish {

// Of α_x and α_y.
struct AlphaRange {
  double least, most;
};

struct LobeFit {
  Lobe lobe;            // α within the range
  double error_square;  // Σ (w_i − k_s g_i)²
};

// `wanted`: L_o of each pair, at least 0. The exponent stays. Where k_s of the start is 0, the start is the result.
LobeFit fit_lobe(MaterialModel model, std::span<const PairBlock> pairs, const float* wanted, const Lobe& start,
                 AlphaRange range);

}  // namespace burnish
