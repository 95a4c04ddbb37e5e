// The mip chain of a polynomial texture map.
//
// Light is linear in the coefficients: under any light, the mean of what texels show is what the mean of their
// coefficients shows. Each texel of a level has that mean, with the weights of core/mip.h. It holds for a polynomial a
// colour; of an LRGB map, whose colour and light have no such mean by themselves, they are multiplied out first.
#pragma once

#include <vector>

#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct PtmMips {
  std::vector<Ptm> levels;      // RGB, base first
  std::vector<double> rms_deg;  // of each level, its normals (ptm_normals.h) against the mean of the base's
};

// `levels` with the base, 0: all. kUsage for more than there are. Memory: 180 bytes a texel.
PtmMips build_ptm_mips(const PtmRows& base, int levels);

// The levels in bytes of one scale and bias, those of the base where it is in RGB bytes and its range otherwise, so
// that textures of all levels are one texture to a shader. `normal`: G (light_matrix.h).
std::vector<PtmBytes> rounded(const PtmMips& mips, const PtmRows& base,
                              const std::array<PtmCoefficients<double>, kPtmTerms>& normal);

}  // namespace burnish
