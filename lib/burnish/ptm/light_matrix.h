// The least-squares problem of a polynomial texture map, which is the same for every texel: the lights decide it.
//
// With row i of B the six terms of light i, coefficients of a texel are a = P p for its values p under the lights,
// P = (BᵀB + λI)⁻¹Bᵀ, by a QR decomposition. A change of the coefficients by d changes the squared error by dᵀGd,
// G = BᵀB: what is lost to rounding is measured by it.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/vec3.h"
#include "burnish/ptm/basis.h"

namespace burnish {

struct LightMatrix {
  std::vector<PtmCoefficients<double>> terms;               // B, a row a light
  std::vector<PtmCoefficients<double>> pseudo_inverse;      // P, a column a light
  std::array<PtmCoefficients<double>, kPtmTerms> normal{};  // G
};

// `name` of the list is for messages. kMalformed for fewer than six lights, and where they do not determine six
// coefficients: repeated, or all on one conic through (u, v).
LightMatrix light_matrix(const std::vector<Vec3d>& lights, double ridge, const std::string& name);

// G, a light, of lights uniform over the solid angle of the hemisphere, for maps whose own lights are not known: the
// means of products of terms, such as 1/3 of u² and 1/15 of u²v².
std::array<PtmCoefficients<double>, kPtmTerms> uniform_normal_matrix();

// R, upper triangular, of G = RᵀR: Cholesky's factor. Where G is singular, as with a ridge alone, its pivots are held
// above a billionth of G's diagonal.
std::array<PtmCoefficients<double>, kPtmTerms> upper_factor(
    const std::array<PtmCoefficients<double>, kPtmTerms>& normal);

}  // namespace burnish
