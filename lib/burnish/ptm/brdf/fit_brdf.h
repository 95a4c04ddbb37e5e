// A BRDF PTM: one polynomial of the light a texel, for homogeneous surfaces (Rost, OpenGL Shading Language, 14.4).
//
// Values are f_r (n·l), 1 being the 255 of photographs. Each texel's coefficients are the least-squares fit over the
// solid angle of the lights that it can be seen under (light_cap.h):
//
//   min ∫_seen w (p(u,v) − f_r (n·l))² dω + 10⁻⁴ ∫_unseen p(u,v)² dω
//
// uniform: w = 1; projected: w = n·v, as pixels of a sphere see the texel, which keeps grazing views, where f_r (n·l)
// of some models has no bound, from bending the polynomial for all others. Lights under which light or view would be
// below the surface never meet the texel; the second term keeps the polynomial bounded where that is nearly all of the
// hemisphere. Texels outside of the unit disc repeat the nearest inside. Row 0 is y = −1, column 0 x = −1: texel i of n
// is at (2i + 1)/n − 1.
//
// LRGB: of the coefficients A (6 × 3), a colour c and a polynomial a with a cᵀ nearest to A by the light they stand
// for, c ≥ 0 with 255 as its largest.
#pragma once

#include "burnish/brdf/brdf.h"
#include "burnish/core/progress.h"
#include "burnish/ptm/brdf/brdf_coordinates.h"
#include "burnish/ptm/ptm.h"

namespace burnish {

inline constexpr int kLargestBrdfPtm = 4096;

enum class LightWeights { kUniform, kProjected };

struct BrdfPtmSettings {
  BrdfCoordinates coordinates = BrdfCoordinates::kHalfDifference;
  LightWeights weights = LightWeights::kUniform;
  int size = 64;  // texels along each side
};

// RGB. In parallel.
Ptm fit_brdf(const Brdf& brdf, const BrdfPtmSettings& settings, const Progress& progress = {});

// An RGB map with one polynomial and a colour a texel instead. In parallel.
Ptm as_lrgb(const Ptm& rgb);

}  // namespace burnish
